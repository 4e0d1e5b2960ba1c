#include "cli/figure/figure_scene.h"

#include "cli/base/json_text.h"

#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>

namespace cli {
namespace {

using nlohmann::ordered_json;

ordered_json vector_json(const glm::dvec3 &vector) {
    return {vector.x, vector.y, vector.z};
}

ordered_json camera_json(const FittedCamera &camera) {
    ordered_json json{{"position", vector_json(camera.position)},
                      {"look_at", vector_json(camera.position + camera.target_distance * camera.frame.forward)},
                      {"up", vector_json(camera.frame.up)}};
    if (camera.projection == Projection::orthographic) {
        json["projection"] = "orthographic";
        json["vertical_extent"] = camera.view_height;
    } else {
        json["vertical_fov"] = camera.vertical_fov * (180.0 / std::numbers::pi);
    }
    return json;
}

void add_lamp(ordered_json &scene, const std::string &name, const StageLamp &lamp) {
    scene["materials"][name] = {{"emission", lamp.emission}};
    scene["spheres"].push_back({{"center", vector_json(lamp.center)}, {"radius", lamp.radius}, {"material", name}});
}

// IEC 61966-2-1.
float linear(std::uint8_t byte) {
    const double signal = byte / 255.0;
    return static_cast<float>(signal <= 0.04045 ? signal / 12.92 : std::pow((signal + 0.055) / 1.055, 2.4));
}

std::string material_name(std::size_t colour) {
    return "colour " + std::to_string(colour);
}

pt_material material_of(const DisplayColour &colour, const Stage &look) {
    pt_material material{};
    for (std::size_t i = 0; i < colour.size(); ++i) {
        material.diffuse[i] = linear(colour[i]);
        material.specular[i] = static_cast<float>(look.specular);
    }
    material.glossiness = static_cast<float>(look.glossiness);
    return material;
}

std::string number_text(double number) {
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

Balls balls_of(const FigureParticles &particles) {
    return {particles.data.positions, particles.radii};
}

std::string sphere_text(const Ball &ball, std::size_t colour) {
    return R"({"center": [)" + number_text(ball.center[0]) + ", " + number_text(ball.center[1]) + ", " +
           number_text(ball.center[2]) + R"(], "radius": )" + number_text(ball.radius) + R"(, "material": ")" +
           material_name(colour) + "\"}";
}

} // namespace

ordered_json stage_json(const FigureLayout &layout, std::uint32_t sample_count) {
    const Stage &stage = layout.stage;
    ordered_json scene;
    scene["camera"] = camera_json(layout.camera);
    scene["film"] = {
        {"width", layout.size.width}, {"height", layout.size.height}, {"exposure", 0}, {"tonemap", "none"}};
    scene["render"] = {{"spp", sample_count}, {"max_path_length", stage.max_path_length}};
    add_lamp(scene, "surround", stage.surround);
    if (stage.key) {
        add_lamp(scene, "key", *stage.key);
    }
    if (stage.floor) {
        scene["materials"]["floor"] = {{"diffuse", stage.floor_albedo}};
        scene["planes"].push_back(
            {{"normal", vector_json(stage.floor->normal)}, {"offset", -stage.floor->height}, {"material", "floor"}});
    }
    return scene;
}

SceneFile stage_scene(const FigureLayout &layout, std::uint32_t sample_count, const std::string &name) {
    return parse_scene(json_text(stage_json(layout, sample_count)), name);
}

SceneFile figure_scene(const SceneFile &stage, const Stage &look, const FigureParticles &particles) {
    SceneFile scene = stage;
    const auto first_material = static_cast<std::uint32_t>(scene.materials.size());
    for (std::size_t i = 0; i < particles.palette.size(); ++i) {
        scene.materials.push_back(material_of(particles.palette[i], look));
        scene.material_names.push_back(material_name(i));
    }
    const Balls balls = balls_of(particles);
    scene.spheres.reserve(scene.spheres.size() + balls.count());
    for (std::size_t i = 0; i < balls.count(); ++i) {
        const Ball ball = balls[i];
        pt_sphere sphere{};
        std::copy_n(glm::value_ptr(ball.center), 3, std::begin(sphere.center));
        sphere.radius = ball.radius;
        sphere.material = first_material + particles.colours[i];
        scene.spheres.push_back(sphere);
    }
    return scene;
}

std::string figure_scene_text(const FigureLayout &layout, std::uint32_t sample_count,
                              const FigureParticles &particles) {
    ordered_json scene = stage_json(layout, sample_count);
    for (std::size_t i = 0; i < particles.palette.size(); ++i) {
        const pt_material material = material_of(particles.palette[i], layout.stage);
        ordered_json &json = scene["materials"][material_name(i)] = {{"diffuse", material.diffuse}};
        if (material.specular[0] > 0.0F) {
            json["specular"] = material.specular[0];
            json["glossiness"] = material.glossiness;
        }
    }
    // Of millions of spheres a tree in memory would take a hundred times their bytes, so they are written as they come.
    ordered_json lamps = std::move(scene["spheres"]);
    scene.erase("spheres");
    std::string text = json_text(scene);
    text.erase(text.rfind("\n}"));
    text += ",\n  \"spheres\": [";
    for (const ordered_json &lamp : lamps) {
        text += (&lamp == &lamps.front() ? "\n    " : ",\n    ") + lamp.dump();
    }
    const Balls balls = balls_of(particles);
    for (std::size_t i = 0; i < balls.count(); ++i) {
        text += ",\n    " + sphere_text(balls[i], particles.colours[i]);
    }
    return text + "\n  ]\n}\n";
}

} // namespace cli
