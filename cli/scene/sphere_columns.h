// Items of the sections `spheres` and `capsules` that are many, with properties as columns: {"center": "a.npy", ...},
// and their NPY files (numpy.org/doc/stable/reference/generated/numpy.lib.format.html).
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

// In row order, little-endian like all processors that run this.
struct NpyArray {
    std::string file; // all bytes; the elements are the last ones
    std::size_t first = 0;
    std::uint32_t type = 0;     // PT_TYPE_*: FLOAT32, FLOAT64, or SRGB8 for uint8
    std::size_t row_count = 0;  // first dimension
    std::size_t row_length = 0; // second dimension; 0: none

    const char *data() const { return file.data() + first; }
    std::uint32_t row_bytes() const;
};

// Reads an array of one or two dimensions in row order, little-endian float32, float64 or uint8, as numpy.save writes
// it. Throws Failure(ExitCode::scene) with the name first for anything else, and for a file that is cut short or
// longer, before reading elements.
NpyArray read_npy(platform::InputFile &file, const std::string &name);

struct SceneFile;
struct SceneKey;

// A value for all spheres, or a file with one for each.
struct SphereColumn {
    const SceneKey *key;
    std::string file; // relative to the scene's folder; empty: `value`
    std::array<double, 3> value{};
    NpyArray array{}; // of the file, once read

    pt_column column() const; // points into this object
};

struct SphereColumns {
    std::string_view section; // spheres or capsules
    std::size_t item = 0;     // index in the section
    std::uint32_t material = 0;
    std::vector<SphereColumn> columns{}; // given ones

    void add_file(const SceneKey &key, const std::string &file, const JsonPlace &place); // throws JsonRefusal
    void add_value(const SceneKey &key, const nlohmann::json &value);                    // value keeps the key's rule

    pt_sphere_array spheres() const; // points into this object
};

// Sorted in the scene's order.
std::vector<std::string> column_paths(const SceneFile &scene);

// Reads the files. Throws Failure: ExitCode::file for one that cannot be read, ExitCode::scene for one that does not
// fit.
void load_columns(SceneFile &scene);

} // namespace cli
