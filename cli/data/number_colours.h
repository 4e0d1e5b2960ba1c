// Perceptual colour maps: brightness grows with the number, and the colour-blind can read them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cli {

// viridis and magma (Smith and van der Walt 2015), cividis (Nunez, Anderton and Renslow 2018).
inline constexpr std::array<std::string_view, 3> colour_map_names{"viridis", "magma", "cividis"};

// sRGB of a number, which is clamped to [0, 1]. The published tables have 256 entries: every fifth is held, and between
// them colours are on straight lines, which differ from the tables by 1/255 at the most, for cividis by 4/255. name:
// one of colour_map_names.
std::array<std::uint8_t, 3> map_colour(std::string_view name, double number);

} // namespace cli
