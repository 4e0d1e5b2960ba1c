// Bytes as text (RFC 4648, section 4).
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace cli {

inline std::string base64(std::span<const std::byte> bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = bytes.size() - i;
        const auto byte = [&](std::size_t j) { return j < count ? std::to_integer<unsigned>(bytes[i + j]) : 0U; };
        const unsigned word = byte(0) << 16 | byte(1) << 8 | byte(2);
        for (std::size_t digit = 0; digit < 4; ++digit) {
            text += digit <= count ? digits[word >> (18 - 6 * digit) & 63U] : '=';
        }
    }
    return text;
}

} // namespace cli
