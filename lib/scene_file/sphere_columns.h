// Items {"center": "a.npy", ...} for many spheres or capsules, and their NPY files
// (numpy.org/doc/stable/reference/generated/numpy.lib.format.html).
#pragma once

#include "lib/platform/input_file.h"
#include "lib/scene_file/json_value.h"

#include <nlohmann/json.hpp>
#include <pt/pt.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pt {

// Row order, little-endian.
struct NpyArray {
    std::string file; // the file's bytes; elements begin at `first`
    std::size_t first = 0;
    std::uint32_t type = 0; // PT_TYPE_FLOAT32, FLOAT64, or SRGB8 for uint8
    std::size_t row_count = 0;
    std::size_t row_length = 0; // 0 if the array has one dimension

    const char *data() const { return file.data() + first; }
    std::uint32_t row_bytes() const;
};

// Reads an array of float32, float64 or uint8 with one or two dimensions. Throws PT_ERROR_INVALID_SCENE for other
// files, before elements are read.
NpyArray read_npy(platform::InputFile &file, const std::string &name);

struct SceneFile;
struct SceneKey;

// A file with a value for each sphere, or one value for all.
struct SphereColumn {
    const SceneKey *key;
    std::string file; // relative to the scene; empty if `value` is used
    std::array<double, 3> value{};
    NpyArray array{};

    pt_column column() const;
};

struct SphereColumns {
    std::string_view section;
    std::size_t item = 0;
    std::uint32_t material = 0;
    std::vector<SphereColumn> columns{};

    void add_file(const SceneKey &key, const std::string &file, const JsonPlace &place);
    void add_value(const SceneKey &key, const nlohmann::json &value); // `value` obeys the rule

    pt_sphere_array spheres() const;
};

std::vector<std::string> column_paths(const SceneFile &scene);

// Throws PT_ERROR_FILE if a file cannot be read, and PT_ERROR_INVALID_SCENE if its array is unsuitable.
void read_columns(SceneFile &scene);

} // namespace pt
