// Copies what was read to an array of a struct of pt.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace cli {

template <typename Number, std::size_t Count>
void store(const std::array<Number, Count> &from, Number (&destination)[Count]) {
    std::copy(from.begin(), from.end(), destination);
}

} // namespace cli
