// The scene file: JSON -> the structs of pt.h. Names, types and units are checked
// here, the rules of a scene by the library; explain() leads its messages back to the file.
#pragma once

#include "cli/base/exit_code.h"
#include "cli/base/json_path.h"
#include "cli/base/library_error.h"
#include "cli/image/exposure.h"
#include "cli/image/tone_map.h"
#include "cli/scene/animation.h"
#include "cli/scene/sphere_columns.h"

#include <pt/pt.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

struct SceneOverride;

// A value that is not the file's own, and where it comes from.
struct OverriddenValue {
    JsonPath path;
    std::string source;
    ExitCode blame;
};

struct SceneFile {
    std::string path;
    std::size_t text_hash; // of what was read
    std::vector<OverriddenValue> overridden;
    std::vector<std::string> material_names; // like all these arrays in the order of the file
    std::vector<pt_material> materials;
    std::vector<std::uint32_t> hidden_materials; // indices of those that are hidden from the camera
    std::vector<pt_sphere> spheres;
    std::vector<std::array<float, 3>> sphere_colours; // of each sphere where any has one, else empty
    std::vector<pt_plane> planes;
    std::vector<SphereColumns> sphere_columns; // without what their files have, before load_columns
    pt_camera camera;
    std::vector<AnimatedValue> animation;

    std::optional<std::uint32_t> width;
    std::optional<std::uint32_t> height;
    std::optional<Exposure> exposure;
    std::optional<ToneCurve> tone_curve;
    std::optional<double> gamma;
    std::optional<std::uint32_t> max_path_length;
    std::optional<std::uint32_t> sample_count;
    std::optional<std::uint64_t> seed;
    std::optional<std::uint32_t> sampler;
    std::optional<std::uint32_t> estimator;

    void add_sphere(const pt_sphere &sphere, const std::optional<std::array<float, 3>> &colour);

    // Both point into this object. Spheres are in the first array if any of them has a colour; each item that is many
    // spheres is another.
    pt_scene scene() const;
    std::vector<pt_sphere_array> sphere_arrays() const;
    std::vector<std::uint32_t> material_flags() const; // empty: 0 for all
    bool is_hidden(std::uint32_t material) const;      // from the camera
    std::size_t item_of(std::size_t sphere) const;     // index in the file's section of spheres[sphere]

    // What the library says of materials[1].glossiness in the file's words, with the line of the file where that can be
    // read again: "scene.json:7: materials.gold.glossiness = -1: must be >= 0".
    std::string explain(const BrokenRule &rule) const;
    std::string explain(const LibraryError &error) const;

    // Where the fault is if that rule is broken: in the file, or in the source of a value in place of its own.
    ExitCode blame(const BrokenRule &rule) const;
};

// Throw Failure(ExitCode::scene) if the text is not a scene file.
SceneFile parse_scene(std::string_view text, const std::string &path);
SceneFile parse_scene(std::string_view text, const std::string &path, const std::vector<SceneOverride> &overrides);

// The path - is standard input. Reads the files of columns too. Throws Failure: ExitCode::file if a file cannot be
// read, ExitCode::scene if it is not what it has to be.
SceneFile read_scene_file(const std::string &path);

// The text of a scene file, and what it is called in messages. path: "-" is standard input. Throws
// Failure(ExitCode::file) if it cannot be read.
struct SceneText {
    std::string path;
    std::string text;
};
SceneText read_scene_text(const std::string &path);

} // namespace cli
