// Unpacks words, most of which are small or one of seven frequent ones, from few bytes: so the build embeds SPIR-V
// (cmake/SpirvToHeader.cmake). The packed form is a sequence of hexadecimal digits, two in a byte, the low one first. A
// word is the number of its digits, 0 to 8, and then these digits; or a single digit 9 to 15 for one of the seven
// frequent words.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// The first count words. frequent: those that the digits 9 to 15 stand for.
std::vector<std::uint32_t> unpacked_words(std::size_t count, std::span<const std::uint8_t> packed,
                                          const std::array<std::uint32_t, 7> &frequent);

} // namespace pt
