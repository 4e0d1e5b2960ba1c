// Which part of a picture the pixels of an image are: all of it, or a crop.
#pragma once

#include "cli/base/number.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cli {

// Pixels; x and y count from the picture's top left corner.
struct Rectangle {
    std::uint32_t x;
    std::uint32_t y;
    std::uint32_t width;
    std::uint32_t height;

    bool operator==(const Rectangle &) const = default;

    std::size_t pixel_count() const { return std::size_t{width} * height; }
};

// "10,20,640,480": x, y, width and height. Nothing unless all four are whole numbers.
inline std::optional<Rectangle> parse_rectangle(std::string_view text) {
    std::array<std::uint32_t, 4> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t comma = i + 1 < numbers.size() ? text.find(',') : text.size();
        const auto number = parse_number<std::uint32_t>(text.substr(0, comma));
        if (!number || comma == std::string_view::npos)
            return std::nullopt;
        numbers[i] = *number;
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return Rectangle{numbers[0], numbers[1], numbers[2], numbers[3]};
}

struct ImageWindow {
    Rectangle part; // within the picture, not empty
    std::uint32_t full_width;
    std::uint32_t full_height;

    bool operator==(const ImageWindow &) const = default;

    bool is_whole() const { return part == Rectangle{0, 0, full_width, full_height}; }
};

inline ImageWindow whole_window(std::uint32_t width, std::uint32_t height) {
    return {{0, 0, width, height}, width, height};
}

// "640x480", or "640x480 at 10,20 of 1920x1080".
inline std::string window_text(const ImageWindow &window) {
    const auto size = [](std::uint32_t width, std::uint32_t height) {
        return std::to_string(width) + "x" + std::to_string(height);
    };
    const Rectangle &part = window.part;
    return size(part.width, part.height) + (window.is_whole()
                                                ? ""
                                                : " at " + std::to_string(part.x) + "," + std::to_string(part.y) +
                                                      " of " + size(window.full_width, window.full_height));
}

} // namespace cli
