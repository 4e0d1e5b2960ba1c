#include "cli/render/description.h"

#include "cli/base/base64.h"
#include "cli/base/vector_width.h"

#include <cstdlib>
#include <span>
#include <string>
#include <vector>

namespace cli {
namespace {

using Json = nlohmann::ordered_json;

// Numbers one after the other, those of vectors too.
template <typename Vector>
void append(Json &row, const Vector &vector) {
    for (const auto component : vector) {
        row.push_back(component);
    }
}

Json materials_of(const SceneFile &file) {
    Json rows = Json::array();
    for (std::uint32_t i = 0; i < file.materials.size(); ++i) {
        const pt_material &material = file.materials[i];
        Json &row = rows.emplace_back(Json::array());
        append(row, material.diffuse);
        append(row, material.specular);
        append(row, material.emission);
        row.push_back(material.glossiness);
        row.push_back(file.is_hidden(i));
    }
    return rows;
}

Json spheres_of(const SceneFile &file) {
    Json rows = Json::array();
    for (const pt_sphere &sphere : file.spheres) {
        Json &row = rows.emplace_back(Json::array());
        append(row, sphere.center);
        row.push_back(sphere.radius);
        append(row, sphere.motion);
        row.push_back(sphere.material);
        if (!file.sphere_colours.empty()) {
            append(row, file.sphere_colours[rows.size() - 1]);
        }
    }
    return rows;
}

// Of millions of numbers, as the machine has them.
template <typename Number>
std::string column_of(const std::vector<Number> &numbers) {
    return base64(std::as_bytes(std::span(numbers)));
}

Json particles_of(const SceneFile &file) {
    Json arrays = Json::array();
    for (const ParticleEntry &entry : file.particles) {
        const bool is_coloured = !entry.colours.empty();
        arrays.push_back({{"center", column_of(entry.positions)},
                          {"radius", column_of(entry.radii)},
                          {"material", entry.material},
                          {"color", is_coloured ? Json(column_of(entry.colours)) : Json(entry.shown_colour.constant)}});
    }
    return arrays;
}

Json planes_of(const SceneFile &file) {
    Json rows = Json::array();
    for (const pt_plane &plane : file.planes) {
        Json &row = rows.emplace_back(Json::array());
        append(row, plane.normal);
        row.push_back(plane.offset);
        row.push_back(plane.material);
    }
    return rows;
}

// Of the driver's variables, those that the program would set or the user has set.
Json environment_of() {
    choose_vector_width();
    Json variables = Json::object();
    for (const char *name : {"LP_NATIVE_VECTOR_WIDTH", "MESA_SHADER_CACHE_DIR", "MESA_SHADER_CACHE_DISABLE"}) {
        if (const char *value = std::getenv(name)) {
            variables[name] = value;
        }
    }
    return variables;
}

Json camera_of(const pt_camera &camera) {
    const bool is_parallel = camera.projection == PT_PROJECTION_ORTHOGRAPHIC;
    return {{"position", camera.position},
            {"target", camera.target},
            {"up", camera.up},
            {"vertical_fov", is_parallel ? Json(nullptr) : Json(camera.vertical_fov)},
            {"shutter", {camera.shutter_open, camera.shutter_close}},
            {"vertical_extent", is_parallel ? Json(camera.vertical_extent) : Json(nullptr)}};
}

} // namespace

Json description_of(const SceneFile &file, const RenderSettings &settings, std::optional<std::uint32_t> frame) {
    const pt_render &render = settings.render;
    const std::optional<double> &stops = settings.exposure.stops;
    return {
        {"frame", frame ? Json(*frame) : Json(nullptr)},
        {"materials", materials_of(file)},
        {"spheres", spheres_of(file)},
        {"sphere_arrays", particles_of(file)},
        {"planes", planes_of(file)},
        {"camera", camera_of(file.camera)},
        {"render",
         {{"width", render.width},
          {"height", render.height},
          {"max_path_length", render.max_path_length},
          {"seed", render.seed},
          {"first_sample", render.first_sample},
          {"estimator", render.estimator},
          {"sampler", render.sampler}}},
        {"samples", settings.sample_count},
        {"target_error", settings.target_error},
        {"sampling", settings.sampling},
        {"display",
         {{"exposure", stops ? Json(*stops) : Json("auto")},
          {"tonemap", tone_curve_names.at(static_cast<std::size_t>(settings.tone_curve))},
          {"gamma", settings.gamma ? Json(*settings.gamma) : Json(nullptr)}}},
        {"environment", environment_of()},
    };
}

std::string description_line(const Json &description) {
    return description.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace cli
