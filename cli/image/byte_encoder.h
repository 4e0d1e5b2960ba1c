// Light to bytes, as the display wants them: a table of where each byte begins, in place of a power for every value.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace cli {

class ByteEncoder {
public:
    // encode: light of the display in [0, 1] to the signal in [0, 1], from 0 to 1 and never falling.
    explicit ByteEncoder(const std::function<double(double)> &encode);

    // The byte of light in [0, 1]: 255 times the signal, rounded, halves up.
    std::uint8_t operator()(double light) const {
        const auto cell = static_cast<std::size_t>(light * cell_count);
        const double *const first = least_light_.data() + cell_bytes_[cell];
        const double *const last = least_light_.data() + cell_bytes_[cell + 1];
        return static_cast<std::uint8_t>(std::upper_bound(first + 1, last + 1, light) - 1 - least_light_.data());
    }

private:
    static constexpr std::size_t cell_count = 4096; // of [0, 1): most of them have one byte or two

    std::array<double, 256> least_light_;                 // of each byte
    std::array<std::uint8_t, cell_count + 2> cell_bytes_; // where a cell begins, 1 being a cell too
};

} // namespace cli
