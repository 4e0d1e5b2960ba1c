#pragma once

#include <algorithm>
#include <array>
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

inline std::optional<double> parse_share(std::string_view text) {
    const bool percent = text.ends_with('%');
    const auto number = parse_number<double>(percent ? text.substr(0, text.size() - 1) : text);
    return number && percent ? std::optional(*number / 100.0) : number;
}

template <std::size_t Count>
std::optional<std::array<std::uint32_t, Count>> parse_numbers(std::string_view text, char mark) {
    std::array<std::uint32_t, Count> numbers{};
    for (std::size_t i = 0; i < Count; ++i) {
        const std::size_t end = i + 1 < Count ? text.find(mark) : text.size();
        const auto number = parse_number<std::uint32_t>(text.substr(0, end));
        if (!number || end == std::string_view::npos)
            return std::nullopt;
        numbers[i] = *number;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return numbers;
}

} // namespace cli
