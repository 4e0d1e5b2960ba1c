// An item of the section `spheres` that is many spheres, whose properties are columns: {"center": "a.npy", ...}.
#pragma once

#include "cli/base/json_path.h"
#include "cli/scene/npy_file.h"

#include <pt/pt.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cli {

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
    std::size_t item = 0; // its index in the section
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
