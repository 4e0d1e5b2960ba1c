// The scene file: JSON -> the structs of pt.h. Names, types and units are checked
// here, the rules of a scene by the library; explain() leads its messages back to the file.
#pragma once

#include "cli/base/context.h"
#include "cli/base/exit_code.h"
#include "cli/image/tone_map.h"
#include "cli/scene/json_items.h"
#include "cli/scene/scene_override.h"
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

// The camera of files without one: it looks from (0, 0, 1) at the origin.
constexpr pt_camera default_camera() {
    auto camera = sized<pt_camera>();
    camera.position[2] = 1.0;
    camera.shutter_close = 1.0;
    return camera;
}

constexpr pt_render default_render() {
    auto render = sized<pt_render>();
    render.width = 512;
    render.height = 512;
    render.max_path_length = PT_DEFAULT_MAX_PATH_LENGTH;
    return render;
}

// What a sphere can have of its own beside its material.
struct Look {
    std::array<float, 3> color{1.0F, 1.0F, 1.0F};
    float opacity = 1.0F;
};

struct Capsule {
    pt_sphere ball; // at one end
    std::array<double, 3> end;
    Look look;
};

struct SceneFile {
    std::string path;
    std::string text;                        // for the line numbers in refusals
    std::vector<SceneOverride> overrides;    // that have taken the place of its values
    std::vector<JsonPath> given;             // keys of `camera`, `film` and `render`, of the file or of overrides
    std::vector<std::string> material_names; // like all arrays from here on in the order of the file
    std::vector<pt_material> materials;
    std::vector<std::uint32_t> used_materials; // in ascending order: those of surfaces
    std::vector<pt_sphere> spheres;
    std::vector<Look> looks; // of each sphere where any has one, else empty
    std::vector<Capsule> capsules;
    std::vector<pt_plane> planes;
    std::vector<SphereColumns> sphere_columns; // without what their files have, before load_columns
    std::vector<AnimatedValue> animation;
    pt_camera camera = default_camera();
    pt_render render = default_render();       // the sections `film` and `render`, with these two
    std::optional<std::uint32_t> sample_count; // of a pixel
    Display display;

    void add_sphere(const pt_sphere &sphere, const std::optional<Look> &look);

    // Both point into this object. Spheres are in the first array if any of them has a look, capsules in the next;
    // each item that is many of either is another.
    pt_scene scene() const;
    std::vector<pt_sphere_array> sphere_arrays() const;
    std::size_t item_of(std::string_view section, std::size_t index) const; // among all of its items, of single ones

    bool gives(const JsonPath &key) const;

    // What the library says of materials[1].glossiness in the words of whoever gave the value: of the file, with its
    // line, "scene.json:7: materials.gold.glossiness = -1: must be >= 0", or of an option.
    std::string explain(const BrokenRule &rule) const;
    std::string explain(const LibraryError &error) const;

    // Where the fault is if that rule is broken: in the file (ExitCode::scene), or in what gave a value in place of it.
    ExitCode blame(const BrokenRule &rule) const;
    ExitCode blame(const LibraryError &error) const;
};

// overrides: what takes the place of its values; a later one counts more. Throws Failure(ExitCode::scene) if the text
// is not a scene file, and blames an override that does not fit.
SceneFile parse_scene(std::string text, const std::string &path, std::vector<SceneOverride> overrides = {});

// What overrides of the section `film` say, where there is no scene file.
Display display_of(const std::vector<SceneOverride> &overrides);

// The same of a file, and of standard input, whose path is -. Throws Failure(ExitCode::file) if it cannot be read.
SceneFile read_scene_file(const std::string &path, std::vector<SceneOverride> overrides = {});

} // namespace cli
