// Packs words, most of them small or one of seven frequent ones, into few bytes: how the build embeds SPIR-V
// (cmake/SpirvToHeader.cmake). A word is the number of its hexadecimal digits, 0 to 8, and the digits; or 9 to 15 for
// one of the seven. These are the digits of the bytes, the low one of each first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// The first count words of packed, whose numbers 9 to 15 stand for those of frequent.
std::vector<std::uint32_t> unpacked_words(std::size_t count, std::span<const std::uint8_t> packed,
                                          const std::array<std::uint32_t, 7> &frequent);

} // namespace pt
