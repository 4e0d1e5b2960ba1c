// Reads scene files into the structs of pt.h. Checks names and types. libpt checks ranges, and explain() translates its
// messages. Throws PT_ERROR_INVALID_SCENE, or SceneOverride::blame if an override is wrong.
#pragma once

#include "lib/base/error.h"
#include "lib/base/struct_size.h"
#include "lib/scene_file/animation.h"
#include "lib/scene_file/json_value.h"
#include "lib/scene_file/sphere_columns.h"
#include "lib/scene_file/sphere_items.h"

#include <pt/display.h>
#include <pt/pt.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pt {

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

constexpr pt_display_info default_display() {
    auto display = sized<pt_display_info>();
    display.automatic_exposure = 1;
    return display;
}

// The source of a value that libpt refuses.
struct RuleSource {
    std::string message;  // "scene.json:7: materials.gold.glossiness = -1: must be >= 0"
    std::size_t line = 0; // 0: the value is not in the file
    const SceneOverride *cause = nullptr;
};

struct SceneFile {
    std::string path;
    std::string text;
    std::vector<SceneOverride> overrides;
    std::vector<JsonPath> given; // keys in `camera`, `film` and `render` that have a value
    std::vector<std::string> material_names;
    std::vector<pt_material> materials;
    std::vector<std::uint32_t> used_materials; // ascending
    std::vector<pt_sphere> spheres;            // empty if sphere_items has items
    SphereItems sphere_items;                  // used if a sphere has a property that pt_sphere lacks
    SphereItems capsules;
    std::vector<pt_plane> planes;
    std::vector<SphereColumns> sphere_columns;
    std::vector<AnimatedValue> animation;
    pt_camera camera = default_camera();
    pt_render render = default_render();
    std::optional<std::uint32_t> sample_count;
    pt_display_info display = default_display();

    // The result points into this object. The arrays are, in this order, single spheres (if one has a property that
    // pt_sphere lacks), capsules, and each item of many spheres.
    pt_scene scene() const;
    std::vector<pt_sphere_array> sphere_arrays() const;
    std::size_t
    item_of(std::string_view section,
            std::size_t index) const; // `index` counts single items; the result counts all items of the section

    bool gives(const JsonPath &key) const;

    // Whether the file or an override sets the field.
    bool gives(const BrokenRule &rule) const;

    RuleSource source_of(const BrokenRule &rule) const;
    std::string explain(const BrokenRule &rule) const { return source_of(rule).message; }

    pt_result blame(const BrokenRule &rule) const;
};

// Later overrides replace earlier ones. `path` is the name in messages, and columns are relative to its folder.
SceneFile scene_of_text(std::string text, const std::string &path, std::vector<SceneOverride> overrides = {});

// Also throws PT_ERROR_FILE.
SceneFile scene_of_file(const std::string &path, std::vector<SceneOverride> overrides = {});

} // namespace pt
