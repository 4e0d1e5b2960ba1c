#include "cli/figure/figure_scene.h"

#include <nlohmann/json.hpp>

#include <numbers>
#include <string>

namespace cli {
namespace {

using nlohmann::ordered_json;

ordered_json camera_json(const FittedCamera &camera) {
    ordered_json json{{"position", camera.position},
                      {"look_at", moved(camera.position, camera.target_distance, camera.frame.forward)},
                      {"up", camera.frame.up}};
    json["vertical_fov"] = camera.vertical_fov * (180.0 / std::numbers::pi);
    return json;
}

void add_lamp(ordered_json &scene, const std::string &name, const StageLamp &lamp) {
    scene["materials"][name] = {{"emission", lamp.emission}};
    scene["spheres"].push_back({{"center", lamp.center}, {"radius", lamp.radius}, {"material", name}});
}

} // namespace

ordered_json figure_scene(const FittedCamera &camera, const Stage &stage, const FigureSettings &settings) {
    ordered_json scene;
    scene["camera"] = camera_json(camera);
    scene["film"] = {{"width", settings.size.width}, {"height", settings.size.height}, {"exposure", 0}, {"tonemap", "none"}};
    scene["render"] = {{"spp", settings.sample_count}, {"max_path_length", stage.max_path_length}};
    add_lamp(scene, "surround", stage.surround);
    if (stage.key) {
        add_lamp(scene, "key", *stage.key);
    }
    ordered_json &particles = scene["materials"][particle_material] = {{"diffuse", 1.0}};
    if (stage.specular > 0.0) {
        particles["specular"] = stage.specular;
        particles["glossiness"] = stage.glossiness;
    }
    if (stage.floor) {
        scene["materials"]["floor"] = {{"diffuse", stage.floor_albedo}};
        scene["planes"].push_back({{"normal", stage.floor->normal}, {"offset", -stage.floor->height}, {"material", "floor"}});
    }
    return scene;
}

} // namespace cli
