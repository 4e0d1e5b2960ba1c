// Frames of an animation, and their numbers in the names of files.
#pragma once

#include "cli/base/number.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cli {

struct FrameRange {
    std::uint32_t first;
    std::uint32_t last; // not before the first
};

// "0-23", or "5" alone; nothing if it is neither.
inline std::optional<FrameRange> parse_frames(std::string_view text) {
    const std::size_t dash = text.find('-');
    const auto first = parse_number<std::uint32_t>(text.substr(0, dash));
    const auto last = dash == std::string_view::npos ? first : parse_number<std::uint32_t>(text.substr(dash + 1));
    return first && last && *first <= *last ? std::optional(FrameRange{*first, *last}) : std::nullopt;
}

// The name of a frame's file: the last row of # signs is its number, with zeros in front up to as many digits. Nothing
// if there is no #.
inline std::optional<std::string> numbered_name(const std::string &pattern, std::uint32_t frame) {
    const std::size_t last = pattern.rfind('#');
    if (last == std::string::npos)
        return std::nullopt;
    const std::size_t first = pattern.find_last_not_of('#', last) + 1; // npos + 1 = 0: the name begins with it
    const std::string digits = std::to_string(frame);
    const std::size_t width = last - first + 1;
    const std::string zeros(width > digits.size() ? width - digits.size() : 0, '0');
    return pattern.substr(0, first) + zeros + digits + pattern.substr(last + 1);
}

} // namespace cli
