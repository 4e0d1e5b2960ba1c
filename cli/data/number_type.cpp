#include "cli/data/number_type.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace cli {
namespace {

template <typename Number>
Number load(const char *bytes, bool reversed) {
    std::array<char, sizeof(Number)> copy;
    std::memcpy(copy.data(), bytes, sizeof(Number));
    if (reversed) {
        std::reverse(copy.begin(), copy.end());
    }
    return std::bit_cast<Number>(copy);
}

// Calls use(Number{}) with the C++ type.
template <typename Use>
auto with_type(NumberType type, Use use) {
    switch (type) {
    case NumberType::int8:
        return use(std::int8_t{});
    case NumberType::uint8:
        return use(std::uint8_t{});
    case NumberType::int16:
        return use(std::int16_t{});
    case NumberType::uint16:
        return use(std::uint16_t{});
    case NumberType::int32:
        return use(std::int32_t{});
    case NumberType::uint32:
        return use(std::uint32_t{});
    case NumberType::int64:
        return use(std::int64_t{});
    case NumberType::uint64:
        return use(std::uint64_t{});
    case NumberType::float32:
        return use(float{});
    default:
        return use(double{});
    }
}

bool is_reversed(NumberFormat format) {
    return format.is_big_endian != (std::endian::native == std::endian::big);
}

} // namespace

std::size_t size_of(NumberType type) {
    return with_type(type, [](auto number) { return sizeof(number); });
}

double read_binary_number(const char *bytes, NumberFormat format) {
    return with_type(format.type, [&](auto number) {
        return static_cast<double>(load<decltype(number)>(bytes, is_reversed(format)));
    });
}

void read_binary_numbers(const char *bytes, std::size_t byte_stride, NumberFormat format, double *numbers,
                         std::size_t number_stride, std::size_t count) {
    const bool reversed = is_reversed(format);
    with_type(format.type, [&](auto number) {
        for (std::size_t i = 0; i < count; ++i) {
            numbers[i * number_stride] = static_cast<double>(load<decltype(number)>(bytes + i * byte_stride, reversed));
        }
    });
}

} // namespace cli
