// Items {"center": "a.npy", ...} that are many spheres or capsules, and their NPY files
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
    std::string file; // the elements begin at `first`
    std::size_t first = 0;
    std::uint32_t type = 0; // PT_TYPE_FLOAT32, FLOAT64, or SRGB8 for uint8
    std::size_t row_count = 0;
    std::size_t row_length = 0; // 0 for one dimension

    const char *data() const { return file.data() + first; }
    std::uint32_t row_bytes() const;
};

// Reads one or two dimensions of float32, float64 or uint8. Throws PT_ERROR_INVALID_SCENE, naming the file, for
// anything else or a wrong size, before reading elements.
NpyArray read_npy(platform::InputFile &file, const std::string &name);

struct SceneFile;
struct SceneKey;

// A file with a value per sphere, or one value for all.
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
    void add_value(const SceneKey &key, const nlohmann::json &value); // `value` keeps the rule

    pt_sphere_array spheres() const;
};

std::vector<std::string> column_paths(const SceneFile &scene);

// Throws PT_ERROR_FILE for an unreadable file, and PT_ERROR_INVALID_SCENE for an unsuitable one.
void read_columns(SceneFile &scene);

} // namespace pt
