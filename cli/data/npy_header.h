// The head of NPY files (numpy.org/doc/stable/reference/generated/numpy.lib.format.html), versions 1.0, 2.0 and 3.0.
#pragma once

#include "cli/data/data_stream.h"
#include "cli/data/number_type.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cli {

// A number within an element of the array; those of a subarray have a name each, "pos[0]". Without a name in arrays of
// plain numbers.
struct NpyField {
    std::string name;
    std::size_t offset; // from the begin of the element, in bytes
    NumberFormat format;
};

struct NpyHeader {
    std::vector<NpyField> fields;
    std::size_t element_size; // in bytes
    bool is_structured;
    bool is_column_major; // "Fortran order"
    std::vector<std::uint64_t> shape;
};

// Takes the head from the stream, and leaves it at the first element. Throws Failure. Fields that are no numbers, like
// texts, are left out; a plain array of such has no fields.
NpyHeader read_npy_header(DataStream &stream);

} // namespace cli
