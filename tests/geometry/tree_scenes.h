#pragma once

#include "lib/scene/camera.h"
#include "lib/scene/scene.h"

#include <pt/pt.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

inline std::vector<pt_sphere> caller_spheres(const std::vector<pt::Sphere> &spheres) {
    std::vector<pt_sphere> result;
    for (const pt::Sphere &s : spheres)
        result.push_back(
            {{s.center.x, s.center.y, s.center.z}, s.radius, {s.motion.x, s.motion.y, s.motion.z}, s.material, 0});
    return result;
}

class TreeScenes {
public:
    explicit TreeScenes(std::uint32_t seed) : engine_(seed) {}

    pt::Scene next(std::size_t most) {
        const auto count = static_cast<std::size_t>(std::exp(uniform(0.0, std::log(static_cast<double>(most) + 0.99))));
        kind_ = (kind_ + 1) % kind_count;
        pt::Scene scene;
        scene.materials = {{glm::vec3(0.5F), glm::vec3(0.0F), glm::vec3(20.0F), 0.0F},
                           {glm::vec3(0.7F, 0.4F, 0.2F), glm::vec3(0.0F), glm::vec3(0.0F), 0.0F},
                           {glm::vec3(0.1F), glm::vec3(0.8F), glm::vec3(0.0F), 300.0F}};
        if (uniform(0.0, 1.0) < 0.5)
            scene.planes.push_back({{0, 1, 0}, 2.5, 1});
        for (std::size_t i = 0; i < count; ++i)
            scene.spheres.push_back(sphere(i, count));
        scene.spheres[count / 2].material = 0;
        return scene;
    }

    // The camera is in a sphere, in front of all or far away. From 10^5 times the scene's size, depths have few
    // values in float32, and a wide view has the horizon.
    pt::Camera camera(const pt::Scene &scene) {
        pt::Camera camera{{0.1, 0.2, 6}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0.0, 1.0};
        const double choice = uniform(0.0, 1.0);
        if (choice < 0.2)
            camera.position = scene.spheres[scene.spheres.size() / 3].center;
        if (choice > 0.7)
            camera.position.z = 4e5;
        if (choice > 0.8)
            camera.view_size = 1e-5;
        return camera;
    }

    std::string kind() const {
        constexpr const char *names[kind_count] = {"uniform", "clustered", "nested", "overlapping",
                                                   "lattice", "far",       "huge",   "moving"};
        return names[kind_];
    }

    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }

private:
    static constexpr int kind_count = 8;

    glm::dvec3 point(double reach) { return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)}; }

    pt::Sphere sphere(std::size_t i, std::size_t count) {
        const double spacing = 4.0 / std::cbrt(static_cast<double>(count));
        const auto material = static_cast<std::uint32_t>(i % 50 == 7 ? 0 : 1 + i % 2);
        pt::Sphere sphere{point(2.0), 0.4 * spacing * uniform(0.3, 1.0), glm::dvec3(0.0), material};
        switch (kind_) {
        case 1:
            sphere.center = i % 3 == 0 ? point(2.0) : glm::dvec3(0.5, -0.3, 1.0) + 1e-3 * point(1.0);
            sphere.radius *= i % 3 == 0 ? 1.0 : 1e-3;
            break;
        case 2:
            sphere.center = glm::dvec3(0.0);
            sphere.radius = 0.5 + 1.5 * static_cast<double>(i) / static_cast<double>(count);
            break;
        case 3:
            sphere.radius = uniform(0.5, 1.0);
            break;
        case 4: {
            const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count))));
            sphere.center = 0.5 * glm::dvec3(static_cast<double>(i % side), static_cast<double>(i / side % side),
                                             static_cast<double>(i / side / side)) -
                            1.0;
            sphere.radius = 0.25;
            break;
        }
        case 5:
            sphere.center *= std::pow(10.0, uniform(0.0, 3.0));
            break;
        case 6:
            if (i % 10 == 0) {
                sphere.radius = std::pow(10.0, uniform(0.0, 6.0));
                sphere.center = glm::dvec3(0, -2.5 - sphere.radius, 0);
            }
            break;
        case 7:
            sphere.motion = i % 2 == 0 ? point(1.0) : glm::dvec3(0.0);
            break;
        default:
            break;
        }
        return sphere;
    }

    std::mt19937 engine_;
    int kind_ = kind_count - 1;
};
