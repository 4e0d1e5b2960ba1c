// Checks for every input, by examine_numbers.cpp (host) or examine_image.cpp (rendered). A failed check ends the
// process.
#pragma once

#include "tests/fuzz/input.h"
#include "tests/fuzz/require.h"

#include <cstdint>
#include <span>

namespace fuzz {

void examine_neighbourhood(const Input &input, std::span<const std::uint8_t> bytes);

// -- by variant --

// An input and its neighbours.
void examine(std::span<const Input> family);

extern const std::uint32_t neighbour_count;

} // namespace fuzz
