// An item of the section `spheres` that is many spheres, whose properties are columns: {"center": "a.npy", ...}.
#pragma once

#include "cli/base/json_value.h"
#include "cli/scene/npy_file.h"

#include <pt/pt.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

struct SceneFile;

// A property: a value for all of the spheres, or a file with one for each.
struct SphereColumn {
    std::string name; // of the key
    std::string file; // relative to the scene's folder; empty: `value`
    std::array<double, 3> value{};
    NpyArray array; // of the file, once it is read

    pt_column column() const; // points into this object
};

struct SphereColumns {
    std::size_t item = 0; // its index in the section
    std::uint32_t material = 0;
    std::vector<SphereColumn> columns; // those that are given

    pt_sphere_array spheres() const; // points into this object
};

// Whether an item of the section is many spheres: its center is the name of a file.
bool is_sphere_columns(const nlohmann::json &item);

// All but the material. Throws JsonRefusal.
SphereColumns read_sphere_columns(const JsonPlace &place, const nlohmann::json &value);

// Where the files are, in the order of the scene.
std::vector<std::string> column_paths(const SceneFile &scene);

// Reads the files. Throws Failure: ExitCode::file for one that cannot be read, ExitCode::scene for one that does not
// fit.
void load_columns(SceneFile &scene);

} // namespace cli
