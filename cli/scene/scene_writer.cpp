#include "cli/scene/scene_writer.h"

#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <ostream>
#include <span>
#include <utility>

namespace cli {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const pt_camera &camera) {
    return {{"projection", camera.projection},
            {"position", camera.position},
            {"target", camera.target},
            {"up", camera.up},
            {"vertical_fov", camera.vertical_fov},
            {"shutter", {camera.shutter_open, camera.shutter_close}},
            {"vertical_extent", camera.vertical_extent},
            {"aperture", camera.aperture},
            {"focus", camera.focus}};
}

Json json_of(const pt_render &render) {
    return {{"width", render.width},     {"height", render.height},
            {"seed", render.seed},       {"max_path_length", render.max_path_length},
            {"sampler", render.sampler}, {"estimator", render.estimator}};
}

Json json_of(const pt_material &material) {
    return {{"diffuse", material.diffuse},
            {"specular", material.specular},
            {"emission", material.emission},
            {"glossiness", material.glossiness},
            {"hidden_from_camera", (material.flags & PT_MATERIAL_HIDDEN_FROM_CAMERA) != 0}};
}

Json json_of(const pt_sphere &sphere) {
    return {
        {"center", sphere.center}, {"radius", sphere.radius}, {"motion", sphere.motion}, {"material", sphere.material}};
}

Json json_of(const pt_plane &plane) {
    return {{"normal", plane.normal}, {"offset", plane.offset}, {"material", plane.material}};
}

struct NamedColumn {
    const char *name;
    pt_column pt_sphere_array::*column;
    std::size_t components;
};

constexpr NamedColumn columns[] = {{"center", &pt_sphere_array::center, 3},     {"radius", &pt_sphere_array::radius, 1},
                                   {"motion", &pt_sphere_array::motion, 3},     {"color", &pt_sphere_array::color, 3},
                                   {"material", &pt_sphere_array::material, 1}, {"end", &pt_sphere_array::end, 3},
                                   {"opacity", &pt_sphere_array::opacity, 1}};
static_assert(offsetof(pt_sphere_array, center) + sizeof(pt_column) * std::size(columns) == sizeof(pt_sphere_array));

std::size_t row_count(const pt_sphere_array &array, const pt_column &column) {
    return column.stride_bytes == 0 ? 1 : array.count;
}

Json json_of(const pt_sphere_array &array) {
    Json named = Json::object();
    for (const NamedColumn &each : columns)
        if (const pt_column &column = array.*each.column; column.data != nullptr)
            named[each.name] = {column.type, row_count(array, column)};
    return named;
}

template <typename Thing>
Json json_of(const Thing *things, std::size_t count) {
    Json array = Json::array();
    for (const Thing &thing : std::span(things, count))
        array.push_back(json_of(thing));
    return array;
}

void write_bytes(std::ostream &stream, const pt_sphere_array &array) {
    for (const NamedColumn &each : columns) {
        const pt_column &column = array.*each.column;
        if (column.data == nullptr)
            continue;
        const std::size_t size = column.type == PT_TYPE_FLOAT64 ? 8 : column.type == PT_TYPE_SRGB8 ? 1 : 4;
        for (std::size_t row = 0; row < row_count(array, column); ++row)
            stream.write(static_cast<const char *>(column.data) + row * column.stride_bytes,
                         static_cast<std::streamsize>(size * each.components));
    }
}

} // namespace

void write_scene(std::ostream &stream, const SceneFile &file, const pt_render &render) {
    const pt_scene scene = file.scene();
    const std::vector<pt_sphere_array> arrays = file.sphere_arrays();
    const Json line{{"camera", json_of(file.camera)},
                    {"render", json_of(render)},
                    {"materials", json_of(scene.materials, scene.material_count)},
                    {"spheres", json_of(scene.spheres, scene.sphere_count)},
                    {"planes", json_of(scene.planes, scene.plane_count)},
                    {"sphere_arrays", json_of(arrays.data(), arrays.size())},
                    {"files", column_paths(file)}};
    stream << line.dump() << '\n';
    for (const pt_sphere_array &array : arrays)
        write_bytes(stream, array);
    stream.flush();
}

} // namespace cli
