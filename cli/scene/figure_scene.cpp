#include "cli/scene/figure_scene.h"

#include "cli/base/json_text.h"
#include "cli/scene/particle_json.h"

#include <nlohmann/json.hpp>

#include <numbers>

namespace cli {
namespace {

using nlohmann::ordered_json;

constexpr const char *particle_material = "particles";

ordered_json vector_json(const glm::dvec3 &vector) {
    return {vector.x, vector.y, vector.z};
}

ordered_json camera_json(const FittedCamera &camera) {
    ordered_json section{{"position", vector_json(camera.position)},
                         {"look_at", vector_json(camera.position + camera.target_distance * camera.frame.forward)},
                         {"up", vector_json(camera.frame.up)}};
    if (camera.projection == Projection::orthographic) {
        section["projection"] = "orthographic";
        section["vertical_extent"] = camera.view_height;
    } else {
        section["vertical_fov"] = camera.vertical_fov * (180.0 / std::numbers::pi);
    }
    return section;
}

void add_lamp(ordered_json &scene, const std::string &name, const StageLamp &lamp) {
    scene["materials"][name] = {{"emission", lamp.emission}};
    scene["spheres"].push_back({{"center", vector_json(lamp.center)}, {"radius", lamp.radius}, {"material", name}});
}

// All but the particles.
ordered_json stage_json(const FigureLayout &layout) {
    const Stage &stage = layout.stage;
    ordered_json scene;
    scene["camera"] = camera_json(layout.camera);
    scene["film"] = {
        {"width", layout.size.width}, {"height", layout.size.height}, {"exposure", 0}, {"tonemap", "none"}};
    scene["render"] = {{"max_path_length", stage.max_path_length}};
    add_lamp(scene, "surround", stage.surround);
    if (stage.key) {
        add_lamp(scene, "key", *stage.key);
    }
    if (stage.floor) {
        scene["materials"]["floor"] = {{"diffuse", stage.floor_albedo}};
        scene["planes"].push_back(
            {{"normal", vector_json(stage.floor->normal)}, {"offset", -stage.floor->height}, {"material", "floor"}});
    }
    ordered_json &material = scene["materials"][particle_material] = {{"diffuse", stage.diffuse}};
    if (stage.specular > 0.0) {
        material["specular"] = stage.specular;
        material["glossiness"] = stage.glossiness;
    }
    return scene;
}

} // namespace

Balls balls_of(const SceneFile &scene) {
    Balls balls;
    for (const ParticleEntry &entry : scene.particles) {
        balls.add(entry.positions, entry.radii);
    }
    return balls;
}

SceneFile stage_scene(const FigureLayout &layout, const std::string &name) {
    return parse_scene(json_text(stage_json(layout)), name);
}

void furnish(SceneFile &scene, const FigureLayout &layout) {
    const SceneFile stage = stage_scene(layout, scene.path);
    const auto first_material = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.insert(scene.materials.end(), stage.materials.begin(), stage.materials.end());
    scene.material_names.insert(scene.material_names.end(), stage.material_names.begin(), stage.material_names.end());
    for (pt_sphere lamp : stage.spheres) {
        lamp.material += first_material;
        scene.add_sphere(lamp, std::nullopt);
    }
    for (pt_plane floor : stage.planes) {
        floor.material += first_material;
        scene.planes.push_back(floor);
    }
    for (ParticleEntry &entry : scene.particles) {
        if (!entry.has_material) {
            entry.material = static_cast<std::uint32_t>(scene.materials.size() - 1); // the last of the stage
        }
    }
    scene.camera = stage.camera;
    if (!scene.width && !scene.height) {
        scene.width = stage.width;
        scene.height = stage.height;
    }
    scene.exposure = scene.exposure ? scene.exposure : stage.exposure;
    scene.max_path_length = scene.max_path_length ? scene.max_path_length : stage.max_path_length;
}

std::string figure_scene_text(const FigureLayout &layout, std::uint32_t sample_count, const ParticleEntry &particles) {
    ordered_json scene = stage_json(layout);
    scene["render"]["spp"] = sample_count;
    ordered_json entry = particle_json(particles);
    entry["material"] = particle_material;
    scene["particles"].push_back(entry);
    return json_text(scene);
}

} // namespace cli
