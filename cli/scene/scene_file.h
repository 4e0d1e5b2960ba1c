// Reads scene files: JSON to the structs of pt.h. Checks names, types and units; the library checks the rules, and
// explain() leads its messages back to the file.
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

// For files without a camera: from (0, 0, 1) to the origin.
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

// A sphere's own properties beside its material.
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
    std::string text;                        // for line numbers in refusals
    std::vector<SceneOverride> overrides;    // of its values
    std::vector<JsonPath> given;             // keys of `camera`, `film` and `render` in the file or overrides
    std::vector<std::string> material_names; // in the file's order, like all arrays from here on
    std::vector<pt_material> materials;
    std::vector<std::uint32_t> used_materials; // of surfaces, in ascending order
    std::vector<pt_sphere> spheres;
    std::vector<Look> looks; // per sphere if any has one, else empty
    std::vector<Capsule> capsules;
    std::vector<pt_plane> planes;
    std::vector<SphereColumns> sphere_columns; // without their files' contents before load_columns
    std::vector<AnimatedValue> animation;
    pt_camera camera = default_camera();
    pt_render render = default_render();       // from the sections `film` and `render`, like the next two
    std::optional<std::uint32_t> sample_count; // of a pixel
    Display display;

    void add_sphere(const pt_sphere &sphere, const std::optional<Look> &look);

    // Both point into this object. The first array has all single spheres if any has a look, the next one capsules,
    // then each item that is many.
    pt_scene scene() const;
    std::vector<pt_sphere_array> sphere_arrays() const;
    std::size_t item_of(std::string_view section,
                        std::size_t index) const; // index of a single item among all items of the section

    bool gives(const JsonPath &key) const;

    // Explains the library's message about a field by its source: with the file's key and line, "scene.json:7:
    // materials.gold.glossiness = -1: must be >= 0", or by an option.
    std::string explain(const BrokenRule &rule) const;
    std::string explain(const LibraryError &error) const;

    // Exit code for a broken rule: of the file (ExitCode::scene) or of the override.
    ExitCode blame(const BrokenRule &rule) const;
    ExitCode blame(const LibraryError &error) const;
};

// overrides: later ones win. Throws Failure(ExitCode::scene) if the text is not a scene file, and blames an override
// that does not fit.
SceneFile parse_scene(std::string text, const std::string &path, std::vector<SceneOverride> overrides = {});

// From overrides of the section `film`, without a scene file.
Display display_of(const std::vector<SceneOverride> &overrides);

// path: - for standard input. Throws Failure(ExitCode::file) if it cannot be read.
SceneFile read_scene_file(const std::string &path, std::vector<SceneOverride> overrides = {});

} // namespace cli
