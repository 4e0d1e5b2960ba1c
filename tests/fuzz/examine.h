// A failed check ends the process.
#pragma once

#include "tests/fuzz/input.h"
#include "tests/fuzz/require.h"

#include <cstdint>
#include <span>

namespace fuzz {

void examine_neighbourhood(const Input &input, std::span<const std::uint8_t> bytes);

void examine(std::span<const Input> family);

extern const std::uint32_t neighbour_count;

} // namespace fuzz
