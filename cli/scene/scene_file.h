// Reads scene files into the structs of pt.h. Checks names, types and units; the library checks ranges, and explain()
// translates its messages.
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

// Looks from (0, 0, 1) to the origin.
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

// A sphere's properties beside its material.
struct Look {
    std::array<float, 3> color{1.0F, 1.0F, 1.0F};
    float opacity = 1.0F;
};

struct Capsule {
    pt_sphere ball;
    std::array<double, 3> end;
    Look look;
};

struct SceneFile {
    std::string path;
    std::string text; // gives messages their line numbers
    std::vector<SceneOverride> overrides;
    std::vector<JsonPath> given;             // keys of `camera`, `film` and `render`
    std::vector<std::string> material_names; // all arrays from here on are in the file's order
    std::vector<pt_material> materials;
    std::vector<std::uint32_t> used_materials; // ascending
    std::vector<pt_sphere> spheres;
    std::vector<Look> looks; // as many as spheres, or empty
    std::vector<Capsule> capsules;
    std::vector<pt_plane> planes;
    std::vector<SphereColumns> sphere_columns; // files are read by load_columns()
    std::vector<AnimatedValue> animation;
    pt_camera camera = default_camera();
    pt_render render = default_render();
    std::optional<std::uint32_t> sample_count; // samples of a pixel
    Display display;

    void add_sphere(const pt_sphere &sphere, const std::optional<Look> &look);

    // Both point into this object. First come single spheres if any has a look, then capsules, then each item that is
    // many.
    pt_scene scene() const;
    std::vector<pt_sphere_array> sphere_arrays() const;
    std::size_t item_of(std::string_view section,
                        std::size_t index) const; // index of a single item among all of the section

    bool gives(const JsonPath &key) const;

    // Messages with the field's source: an option, or file and line, as in "scene.json:7: materials.gold.glossiness =
    // -1: must be >= 0".
    std::string explain(const BrokenRule &rule) const;
    std::string explain(const LibraryError &error) const;

    // ExitCode::scene, or the override's.
    ExitCode blame(const BrokenRule &rule) const;
    ExitCode blame(const LibraryError &error) const;
};

// Later overrides win. Throws Failure: for the text ExitCode::scene, for a wrong override its `blame`.
SceneFile parse_scene(std::string text, const std::string &path, std::vector<SceneOverride> overrides = {});

// For commands without a scene file.
Display display_of(const std::vector<SceneOverride> &overrides);

// path "-": standard input. Throws Failure.
SceneFile read_scene_file(const std::string &path, std::vector<SceneOverride> overrides = {});

} // namespace cli
