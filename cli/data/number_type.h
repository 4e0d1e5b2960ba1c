// Numbers as binary files have them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace cli {

enum class NumberType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

struct NumberFormat {
    NumberType type;
    bool is_big_endian;
};

std::size_t size_of(NumberType type); // in bytes

double read_binary_number(const char *bytes, NumberFormat format);

// Of count records: from bytes, and then every so many bytes, to numbers, and then every so many of these.
void read_binary_numbers(const char *bytes, std::size_t byte_stride, NumberFormat format, double *numbers,
                         std::size_t number_stride, std::size_t count);

} // namespace cli
