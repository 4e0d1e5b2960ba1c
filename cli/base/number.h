// Reads numbers and sizes from the text of options: the whole text or nothing, no octal, no wrap-around.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>

namespace cli {

template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    if constexpr (std::is_floating_point_v<Number>) {
        if (!std::isfinite(number))
            return std::nullopt;
    }
    return number;
}

// "0.005" or "0.5%", both 0.005.
inline std::optional<double> parse_share(std::string_view text) {
    const bool percent = text.ends_with('%');
    const auto number = parse_number<double>(percent ? text.substr(0, text.size() - 1) : text);
    return number && percent ? std::optional(*number / 100.0) : number;
}

struct ImageSize {
    std::uint32_t width;
    std::uint32_t height;
};

// "1920x1080"; nothing unless both are whole numbers. Which sizes are possible is the library's to say.
inline std::optional<ImageSize> parse_size(std::string_view text) {
    const std::size_t cross = text.find('x');
    if (cross == std::string_view::npos)
        return std::nullopt;
    const auto width = parse_number<std::uint32_t>(text.substr(0, cross));
    const auto height = parse_number<std::uint32_t>(text.substr(cross + 1));
    if (!width || !height)
        return std::nullopt;
    return ImageSize{*width, *height};
}

} // namespace cli
