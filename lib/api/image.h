// Where a caller wants an image, checked against its size.
#pragma once

#include <pt/pt.h>

#include <cstddef>
#include <cstdint>

namespace pt {

struct Image {
    float *data;
    std::size_t row_floats; // distance between rows
    std::uint32_t quantity; // PT_QUANTITY_*
};

// Checks that an image whose struct_size is settled holds width x height pixels, both >= 1. Throws
// PT_ERROR_INVALID_ARGUMENT with all broken rules.
Image validated_image(const pt_image &source, std::uint32_t width, std::uint32_t height);

} // namespace pt
