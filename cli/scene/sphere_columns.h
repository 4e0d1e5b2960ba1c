// An item of the sections `spheres` or `capsules` that is many of them, whose properties are columns: {"center":
// "a.npy", ...}, and the files of these in NumPy's format NPY
// (numpy.org/doc/stable/reference/generated/numpy.lib.format.html).
#pragma once

#include "cli/base/json.h"
#include "lib/platform/input_file.h"

#include <nlohmann/json.hpp>
#include <pt/pt.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

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

// Reads an array of one or two lengths in row order, of float32, float64 or uint8 in little-endian bytes, as numpy.save
// writes it. Throws Failure(ExitCode::scene), whose message begins with the name, for anything else, and for a file
// that is cut short or goes on after the array, before the elements are read.
NpyArray read_npy(platform::InputFile &file, const std::string &name);

struct SceneFile;
struct SceneKey;

// A property: a value for all of the spheres, or a file with one for each.
struct SphereColumn {
    const SceneKey *key;
    std::string file; // relative to the scene's folder; empty: `value`
    std::array<double, 3> value{};
    NpyArray array{}; // of the file, once it is read

    pt_column column() const; // points into this object
};

struct SphereColumns {
    std::string_view section; // spheres or capsules
    std::size_t item = 0;     // its index there
    std::uint32_t material = 0;
    std::vector<SphereColumn> columns{}; // those that are given

    void add_file(const SceneKey &key, const std::string &file, const JsonPlace &place); // throws JsonRefusal
    void add_value(const SceneKey &key, const nlohmann::json &value);                    // that keeps the key's rule

    pt_sphere_array spheres() const; // points into this object
};

// Where the files are, in the order of the scene.
std::vector<std::string> column_paths(const SceneFile &scene);

// Reads the files. Throws Failure: ExitCode::file for one that cannot be read, ExitCode::scene for one that does not
// fit.
void load_columns(SceneFile &scene);

} // namespace cli
