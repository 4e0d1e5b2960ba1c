// The color map viridis (Smith and van der Walt 2015): brightness grows with the number, and the color-blind can read
// it.
#pragma once

#include <array>
#include <cstdint>

namespace cli {

// sRGB of a number, which is clamped to [0, 1]. The published table has 256 entries: every fifth is held, and between
// them colors are on straight lines, which differ from the table by 1/255 at the most.
std::array<std::uint8_t, 3> viridis(double number);

} // namespace cli
