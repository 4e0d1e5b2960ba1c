#include "lib/base/packed_words.h"

namespace pt {

std::vector<std::uint32_t> unpacked_words(std::size_t count, std::span<const std::uint8_t> packed,
                                          const std::array<std::uint32_t, 7> &frequent) {
    std::size_t place = 0;
    const auto next_digit = [&] {
        const std::uint32_t byte = packed[place / 2];
        return place++ % 2 == 0 ? byte & 15U : byte >> 4;
    };
    std::vector<std::uint32_t> words(count);
    for (std::uint32_t &word : words) {
        const std::uint32_t digits = next_digit();
        if (digits > 8)
            word = frequent[digits - 9];
        else
            for (std::uint32_t i = 0; i < digits; ++i)
                word = word << 4 | next_digit();
    }
    return words;
}

} // namespace pt
