// A scene of another program in that program's terms, where lights are points and directions without a size.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

using ForeignVector = std::array<double, 3>;

struct ForeignCamera {
    ForeignVector position{};
    ForeignVector look_at{};
    ForeignVector up{};
    double vertical_fov = 0.0;             // degrees
    std::optional<double> vertical_extent; // of parallel rays, in place of the angle
};

struct ForeignMaterial {
    std::string name;
    ForeignVector diffuse{};
    ForeignVector specular{};
    double glossiness = 0.0;
};

struct ForeignSphere {
    ForeignVector center;
    double radius; // > 0
    std::size_t material;
};

struct ForeignPlane {
    ForeignVector normal; // not 0
    double offset;
    std::size_t material;
};

// What a white diffuse surface that faces the light reflects, as a radiance, is color divided by
// attenuation[0] + attenuation[1] d + attenuation[2] d^2 at the distance d.
struct ForeignLight {
    std::string file_place; // "scene.nff:7", for messages
    bool is_directional;
    ForeignVector place; // or the direction towards the light, not 0
    ForeignVector color;
    ForeignVector attenuation{1.0, 0.0, 0.0};
    double radius = 0.0; // at which it is seen; 0 if it has none
};

struct ForeignScene {
    ForeignCamera camera;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    ForeignVector background{};
    std::vector<ForeignMaterial> materials;
    std::vector<ForeignSphere> spheres;
    std::vector<ForeignPlane> planes;
    std::vector<ForeignLight> lights;
    std::vector<std::string> left_out; // warnings: what the file has and the picture will not
};

} // namespace cli
