// Unpacks embedded SPIR-V (cmake/SpirvToHeader.cmake): hexadecimal digits, two per byte, the low one first. A word is
// its number of digits, 0 to 8, and the digits; or a digit 9 to 15 for one of seven frequent words.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pt {

std::vector<std::uint32_t> unpacked_words(std::size_t count, std::span<const std::uint8_t> packed,
                                          const std::array<std::uint32_t, 7> &frequent);

} // namespace pt
