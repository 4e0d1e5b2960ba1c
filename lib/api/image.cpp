// The rules of an image in the caller's memory; see image.h.
#include "lib/api/image.h"

#include "lib/base/rules.h"

#include <string>

namespace pt {

Image validated_image(const pt_image &source, std::uint32_t width, std::uint32_t height) {
    Violations violations;
    const Subject image(violations, "image");
    const std::uint64_t width_bytes = std::uint64_t{width} * 3 * sizeof(float);
    const std::uint64_t row_bytes = source.row_bytes == 0 ? width_bytes : source.row_bytes;
    image.require(source.quantity <= PT_QUANTITY_STANDARD_ERROR, "quantity", source.quantity,
                  "must be a PT_QUANTITY_* of pt.h");
    if (!source.data)
        image.refuse("data", "NULL", "must not be NULL");
    image.require(reinterpret_cast<std::uintptr_t>(source.data) % alignof(float) == 0, "data",
                  std::uint64_t{reinterpret_cast<std::uintptr_t>(source.data)}, "must be a multiple of 4");
    image.require(row_bytes % sizeof(float) == 0, "row_bytes", row_bytes, "must be a multiple of 4");
    image.require(row_bytes >= width_bytes, "row_bytes", row_bytes,
                  "must be >= width * 12 (" + number_text(width_bytes) + ")");
    // (height - 1) * row_bytes + width_bytes <= size_bytes, by division: the product may pass 2^64.
    const bool large_enough =
        source.size_bytes >= width_bytes && (source.size_bytes - width_bytes) / row_bytes >= height - 1;
    image.require(large_enough, "size_bytes", source.size_bytes,
                  "must be >= (height - 1) * row_bytes + width * 12 (" + number_text(height - 1) + " * " +
                      number_text(row_bytes) + " + " + number_text(width_bytes) + ")");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    return {source.data, static_cast<std::size_t>(row_bytes / sizeof(float)), source.quantity};
}

} // namespace pt
