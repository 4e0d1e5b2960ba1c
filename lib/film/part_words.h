// Adds the exact sums of consecutive pixels in one part of a film to those in another part, and subtracts them again.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pt {

// The words of a part, plane by plane, as in gpu_layout.h. Word: std::uint32_t, or const.
template <typename Word>
struct PartWords {
    Word *first;        // of the first pixel's
    std::size_t stride; // from a plane to the next
};

void add_words(const PartWords<std::uint32_t> &to, const PartWords<const std::uint32_t> &from,
               std::size_t pixel_count) noexcept;

// Undoes the addition.
void subtract_words(const PartWords<std::uint32_t> &to, const PartWords<const std::uint32_t> &from,
                    std::size_t pixel_count) noexcept;

} // namespace pt
