// Unpacks embedded SPIR-V (cmake/SpirvToHeader.cmake). Each byte has two hexadecimal digits, the low one first. A word
// begins with a digit n. If n is at most 8, n digits of the word follow. A larger n stands for one of seven frequent
// words.
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
