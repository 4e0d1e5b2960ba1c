// The interface of libpt-image-file.so. Only this module links OpenImageIO, which loads slowly. Failures are
// std::runtime_error.
#pragma once

#include "cli/base/number.h"
#include "cli/base/text.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cli {

// In pixels from the top left.
struct Rectangle {
    std::uint32_t x;
    std::uint32_t y;
    std::uint32_t width;
    std::uint32_t height;

    bool operator==(const Rectangle &) const = default;

    std::size_t pixel_count() const { return std::size_t{width} * height; }
};

inline std::optional<Rectangle> parse_rectangle(std::string_view text) {
    const auto numbers = parse_numbers<4>(text, ',');
    return numbers ? std::optional(Rectangle{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]})
                   : std::nullopt;
}

struct ImageWindow {
    Rectangle part;
    std::uint32_t full_width;
    std::uint32_t full_height;

    bool operator==(const ImageWindow &) const = default;

    bool is_whole() const { return part == Rectangle{0, 0, full_width, full_height}; }
};

inline ImageWindow whole_window(std::uint32_t width, std::uint32_t height) {
    return {{0, 0, width, height}, width, height};
}

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
    std::variant<std::string, std::int32_t, double> value; // doubles are float32 in a file
};

inline std::string attribute_text(const ImageAttribute &attribute) {
    if (const auto *text = std::get_if<std::string>(&attribute.value))
        return *text;
    if (const auto *whole = std::get_if<std::int32_t>(&attribute.value))
        return std::to_string(*whole);
    return formatted("%.9g", std::get<double>(attribute.value));
}

enum class LayerKind {
    color,
    vector, // X, Y, Z
    numbers // one uint32
};

struct ImageLayer {
    std::string name; // empty for the main layer
    LayerKind kind;
    std::size_t channel_count;
    std::span<const float> values;               // pixel by pixel, from the top left
    std::span<const std::uint32_t> numbers = {}; // only for LayerKind::numbers
};

// Has either layers of radiance or signals.
struct ImageData {
    ImageWindow window;
    std::span<const ImageLayer> layers = {};
    std::span<const std::uint8_t> signals = {}; // R, G, B of each pixel; PNG may add A, not premultiplied
    std::optional<double> gamma = {};           // for PNG, the exponent from signal to light; empty for sRGB
    std::span<const ImageAttribute> attributes = {};

    bool has_alpha() const { return signals.size() == 4 * window.part.pixel_count(); }
};

using EncodeImage = void(const ImageData &image, const char *extension, std::vector<unsigned char> &file);

struct DecodedImage {
    std::string path;
    std::int32_t x; // may lie outside the picture
    std::int32_t y;
    std::uint32_t width;
    std::uint32_t height;
    std::uint32_t full_width;
    std::uint32_t full_height;
    bool is_float; // otherwise integers scaled to [0, 1]
    std::vector<std::string> channels;
    std::vector<float> values;
    std::vector<ImageAttribute> attributes;

    // Negative x and y become large numbers (modulo 2^32).
    ImageWindow window() const {
        return {{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), width, height}, full_width, full_height};
    }

    // Three values per pixel. A single channel is repeated. An empty name means the main layer. Throws
    // Failure(ExitCode::file) if there is no such layer.
    std::vector<float> layer(const std::string &name) const;
};

using DecodeImage = void(const std::string &path, DecodedImage &image);

inline constexpr const char *encode_image_symbol = "pt_encode_image";
inline constexpr const char *decode_image_symbol = "pt_decode_image";

} // namespace cli
