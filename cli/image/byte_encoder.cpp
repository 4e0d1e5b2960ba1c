#include "cli/image/byte_encoder.h"

#include <bit>
#include <cmath>

namespace cli {
namespace {

// The least light in (low, 1] whose signal is a byte or more. Numbers >= 0 are ordered as their bits are.
double least_light_of(long byte, double low, const std::function<double(double)> &encode) {
    auto below = std::bit_cast<std::uint64_t>(low);
    auto least = std::bit_cast<std::uint64_t>(1.0);
    while (least - below > 1) {
        const std::uint64_t middle = below + (least - below) / 2;
        const bool reaches = std::lround(encode(std::bit_cast<double>(middle)) * 255.0) >= byte;
        (reaches ? least : below) = middle;
    }
    return std::bit_cast<double>(least);
}

} // namespace

ByteEncoder::ByteEncoder(const std::function<double(double)> &encode) {
    least_light_[0] = 0.0;
    for (std::size_t byte = 1; byte < least_light_.size(); ++byte)
        least_light_[byte] = least_light_of(static_cast<long>(byte), least_light_[byte - 1], encode);
    for (std::size_t cell = 0; cell < cell_bytes_.size(); ++cell) {
        const double begin = static_cast<double>(cell) / cell_count;
        const auto above = std::upper_bound(least_light_.begin(), least_light_.end(), begin);
        cell_bytes_[cell] = static_cast<std::uint8_t>(above - least_light_.begin() - 1);
    }
}

} // namespace cli
