// The interface between the program and the module libpt-image-file.so, which alone links OpenImageIO: its 261 shared
// objects and 0.2 s are paid only for other formats than PNG. Both are built together: the types are C++, and failures
// are std::runtime_error.
#pragma once

#include "cli/base/number.h"
#include "cli/base/text.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

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
    const auto numbers = parse_numbers<4>(text, ',');
    return numbers ? std::optional(Rectangle{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]})
                   : std::nullopt;
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

struct ImageAttribute {
    std::string name;
    std::variant<std::string, std::int32_t, double> value; // double is float32 in a file
};

// For formats whose metadata consist of text only (PNG, JPEG).
inline std::string attribute_text(const ImageAttribute &attribute) {
    if (const auto *text = std::get_if<std::string>(&attribute.value))
        return *text;
    if (const auto *whole = std::get_if<std::int32_t>(&attribute.value))
        return std::to_string(*whole);
    return formatted("%.9g", std::get<double>(attribute.value));
}

enum class LayerKind {
    color,  // R, G and B; or one number, for which the layer is the channel
    vector, // X, Y and Z
    numbers // one whole number
};

// Channels of an image whose values are stored together.
struct ImageLayer {
    std::string name; // empty for the main one
    LayerKind kind;
    std::size_t channel_count;                   // 3 or 1
    std::span<const float> values;               // pixel by pixel, row by row from the top
    std::span<const std::uint32_t> numbers = {}; // in place of them, of LayerKind::numbers
};

// Layers for formats of radiance, signals for the others.
struct ImageData {
    ImageWindow window;
    std::span<const ImageLayer> layers = {};
    std::span<const std::uint8_t> signals = {}; // R, G, B of each pixel, for PNG also R, G, B, A, not multiplied by A
    std::optional<double> gamma = {}; // light is the signal to this power; nothing: by the sRGB curve. For PNG
    std::span<const ImageAttribute> attributes = {};

    bool has_alpha() const { return signals.size() == 4 * window.part.pixel_count(); }
};

// Encodes an image in memory.
using EncodeImage = void(const ImageData &image, const char *extension, std::vector<unsigned char> &file);

// What a file holds.
struct DecodedImage {
    std::string path;
    std::int32_t x; // where the pixels begin in the picture; may lie outside of it
    std::int32_t y;
    std::uint32_t width; // of the pixels
    std::uint32_t height;
    std::uint32_t full_width; // of the picture
    std::uint32_t full_height;
    bool is_float;                     // otherwise whole numbers, as displays take them, scaled to [0, 1]
    std::vector<std::string> channels; // their names
    std::vector<float> values;         // channel by channel of a pixel, row by row from the top
    std::vector<ImageAttribute> attributes;

    // Three values a pixel: the channels R, G and B of a layer, or X, Y and Z, or three times its only one. The main
    // layer has no name. Throws Failure(ExitCode::file) if there is none of that name.
    std::vector<float> layer(const std::string &name) const;
};

// Reads a file in any format that OpenImageIO knows.
using DecodeImage = void(const std::string &path, DecodedImage &image);

inline constexpr const char *encode_image_symbol = "pt_encode_image";
inline constexpr const char *decode_image_symbol = "pt_decode_image";

} // namespace cli
