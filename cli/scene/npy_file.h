// Columns of numbers in files of NumPy's format NPY (numpy.org/doc/stable/reference/generated/numpy.lib.format.html).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace cli {

// An array whose elements follow one another by rows, in the byte order of the processors that run this: little-endian.
struct NpyArray {
    std::string file; // all of its bytes; the elements are its last ones
    std::size_t first = 0;
    std::uint32_t type = 0;     // PT_TYPE_*: FLOAT32, FLOAT64, or SRGB8 for uint8
    std::size_t row_count = 0;  // first length of the shape
    std::size_t row_length = 0; // the second one; 0: the shape has one length

    const char *data() const { return file.data() + first; }
    std::uint32_t row_bytes() const;
};

// Of a whole file. Throws Failure(ExitCode::scene), whose message begins with the name, for all that is not an array of
// one or two lengths in row order, of float32, float64 or uint8 in little-endian bytes, as numpy.save writes it; and
// for a file that is cut short or goes on after it.
NpyArray parse_npy(std::string file, const std::string &name);

} // namespace cli
