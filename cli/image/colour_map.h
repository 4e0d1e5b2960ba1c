// Colours that stand for numbers: the map viridis (Smith and van der Walt 2015), whose brightness grows with the number
// and which the colour-blind can read. From the image module, for OpenImageIO has it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace cli {

// R, G, B as displays take them for each number of [0, 1], dark to bright; white for NaN. width numbers to a row.
// Throws Failure, as for images that are read.
std::vector<std::uint8_t> map_colours(std::span<const float> numbers, std::uint32_t width);

} // namespace cli
