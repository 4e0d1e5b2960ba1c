#include "cli/scene/surface_sections.h"

#include "cli/base/store.h"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace cli {

using nlohmann::json;

void SurfaceSections::material(const JsonPlace &place, const json &value) {
    const JsonObject object(value, place, {"diffuse", "specular", "glossiness", "emission", "hidden_from_camera"});
    pt_material material{};
    if (const json *diffuse = object.find("diffuse"))
        store(read_colour(*diffuse, place.member("diffuse")), material.diffuse);
    if (const json *specular = object.find("specular"))
        store(read_colour(*specular, place.member("specular")), material.specular);
    if (const json *glossiness = object.find("glossiness"))
        material.glossiness = read_float(*glossiness, place.member("glossiness"));
    if (const json *emission = object.find("emission"))
        store(read_colour(*emission, place.member("emission")), material.emission);
    const json *hidden = object.find("hidden_from_camera");
    const bool is_hidden = hidden != nullptr && read_boolean(*hidden, place.member("hidden_from_camera"));
    if (is_hidden)
        scene_.hidden_materials.push_back(static_cast<std::uint32_t>(scene_.materials.size()));
    scene_.materials.push_back(material);
    scene_.material_names.emplace_back(place.key);
}

void SurfaceSections::sphere(const JsonPlace &place, const json &value) {
    if (is_sphere_columns(value)) {
        SphereColumns columns = read_sphere_columns(place, value);
        columns.material = references_.number(place.member("material"), value.at("material"));
        scene_.sphere_columns.push_back(std::move(columns));
        return;
    }
    const JsonObject object(value, place, {"center", "radius", "material", "motion", "color"});
    pt_sphere sphere{};
    store(read_vector(object.require("center"), place.member("center")), sphere.center);
    sphere.radius = read_number(object.require("radius"), place.member("radius"));
    sphere.material = references_.number(place.member("material"), object.require("material"));
    if (const json *motion = object.find("motion"))
        store(read_vector(*motion, place.member("motion")), sphere.motion);
    const json *colour = object.find("color");
    scene_.add_sphere(sphere,
                      colour == nullptr ? std::nullopt : std::optional(read_colour(*colour, place.member("color"))));
}

void SurfaceSections::plane(const JsonPlace &place, const json &value) {
    const JsonObject object(value, place, {"normal", "offset", "material"});
    pt_plane plane{};
    store(read_vector(object.require("normal"), place.member("normal")), plane.normal);
    plane.offset = read_number(object.require("offset"), place.member("offset"));
    plane.material = references_.number(place.member("material"), object.require("material"));
    scene_.planes.push_back(plane);
}

void SurfaceSections::resolve_materials() {
    const std::vector<std::uint32_t> indices = references_.indices(scene_.material_names);
    for (pt_sphere &sphere : scene_.spheres)
        sphere.material = indices[sphere.material];
    for (SphereColumns &each : scene_.sphere_columns)
        each.material = indices[each.material];
    for (pt_plane &plane : scene_.planes)
        plane.material = indices[plane.material];
}

} // namespace cli
