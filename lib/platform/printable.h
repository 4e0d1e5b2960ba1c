// Makes text from outside harmless for terminals: names of files, messages of compilers and drivers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace platform {

struct Character {
    char32_t code;
    std::size_t size;
};

// Decodes the first character of UTF-8. A byte that does not begin a valid sequence is taken as Latin-1.
inline Character first_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::size_t size = byte(0) < 0xc0 || byte(0) > 0xf7 ? 1 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
    char32_t code = size == 1 ? byte(0) : byte(0) & (0x7fU >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if (i >= text.size() || (byte(i) & 0xc0U) != 0x80)
            return {byte(0), 1};
        code = code << 6 | (byte(i) & 0x3fU);
    }
    return {code, size};
}

// Whether a character moves the cursor, changes the terminal, begins a line, or reorders other characters (UAX #9,
// table 1).
constexpr bool is_control(char32_t code) {
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x61c || code == 0x200e || code == 0x200f ||
           (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

// Writes control characters as <U+001B>, except those in `kept`.
inline std::string printable(std::string_view text, std::string_view kept = "") {
    std::string shown;
    while (!text.empty()) {
        const auto [code, size] = first_character(text);
        const std::string_view character = text.substr(0, size);
        text.remove_prefix(size);
        if (!is_control(code) || kept.find(character) != std::string_view::npos) {
            shown += character;
            continue;
        }
        std::array<char, 16> name{};
        std::snprintf(name.data(), name.size(), "<U+%04X>", static_cast<unsigned>(code));
        shown += name.data();
    }
    return shown;
}

inline std::string printable_lines(std::string_view text) {
    return printable(text, "\n");
}

} // namespace platform
