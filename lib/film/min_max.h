// The smaller and the larger of two numbers, as values: in loops compilers turn these into vector instructions, unlike
// references. Where one is not a number the first is returned, as by std::min and std::max.
#pragma once

namespace pt {

template <typename Number>
constexpr Number less_of(Number a, Number b) {
    return b < a ? b : a;
}

template <typename Number>
constexpr Number more_of(Number a, Number b) {
    return a < b ? b : a;
}

} // namespace pt
