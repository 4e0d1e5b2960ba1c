// Checks what must hold for every input, in two variants: examine_numbers.cpp (host, no device) and examine_image.cpp
// (rendered). A program links one of them. A check that fails ends the process.
#pragma once

#include "tests/fuzz/input.h"
#include "tests/fuzz/require.h"

#include <cstdint>
#include <span>

namespace fuzz {

// The input, and with it neighbours of it that the bytes choose.
void examine_neighbourhood(const Input &input, std::span<const std::uint8_t> bytes);

// -- of the flavour --

// An input and its neighbours.
void examine(std::span<const Input> family);

// How many neighbours are worth their time.
extern const std::uint32_t neighbour_count;

} // namespace fuzz
