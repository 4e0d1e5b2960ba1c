#pragma once

#include "lib/view/view.h"

#include <pt/pt.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

struct LampScene {
    std::string name;
    pt::Scene scene;
};

namespace lamp_scenes {

inline pt::Camera camera() {
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0.25, 0.75};
}

inline pt::View view_of(const pt::Scene &scene, const pt::Camera &seen_by = camera(),
                        std::uint32_t estimator = PT_ESTIMATOR_MIS) {
    return pt::view_of(pt::PreparedScene(scene), seen_by, {16, 12, 3, 0, 0, estimator, PT_SAMPLER_RANDOM, 0, 12});
}

inline void add_lamp(pt::Scene &scene, const glm::dvec3 &center, double radius, double radiance,
                     const glm::dvec3 &motion = glm::dvec3(0.0)) {
    scene.materials.push_back({glm::vec3(0), glm::vec3(0), glm::vec3(static_cast<float>(radiance)), 0});
    scene.spheres.push_back({center, radius, motion, static_cast<std::uint32_t>(scene.materials.size() - 1)});
}

inline pt::Scene in_a_box(std::uint32_t count, double decades, double motion = 0.0) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto between = [&](double low, double high) { return low + (high - low) * unit(generator); };
    pt::Scene scene;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 center(between(-10, 10), between(0.3, 8), between(-10, 10));
        const glm::dvec3 way(between(-motion, motion), between(0, motion), between(-motion, motion));
        add_lamp(scene, center, between(0.005, 0.02), std::pow(10.0, between(0, decades)), way);
    }
    return scene;
}

inline pt::Scene in_clusters(std::uint32_t count) {
    std::mt19937 generator(8);
    std::normal_distribution<double> normal;
    pt::Scene scene;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 2.4 * (i % 13);
        const glm::dvec3 middle(8 * std::cos(angle), 0.4 * (i % 13) - 0.1, 8 * std::sin(angle));
        const glm::dvec3 offset(normal(generator), normal(generator), normal(generator));
        add_lamp(scene, middle + 0.1 * offset, 0.004, 1.0 + i % 5);
    }
    return scene;
}

inline pt::Scene nested(std::uint32_t count) {
    pt::Scene scene;
    for (std::uint32_t i = 0; i < count; ++i)
        add_lamp(scene, {3.0 * (i % 5) - 6, 4, -9}, 0.01 * (1 + i / 5), 1.0 + i % 3);
    return scene;
}

// All other lamps have 10^-8 of the strong lamp's power.
inline pt::Scene with_a_strong_one(std::uint32_t count) {
    pt::Scene scene = in_a_box(count, 1);
    scene.materials[count / 3].emission = glm::vec3(1e9F);
    return scene;
}

inline std::vector<LampScene> all() {
    return {{"box of 33", in_a_box(33, 8)},
            {"box of 64", in_a_box(64, 4)},
            {"box of 65", in_a_box(65, 4)},
            {"box of 1000", in_a_box(1000, 8)},
            {"moving box", in_a_box(300, 4, 2.0)},
            {"clusters", in_clusters(500)},
            {"nested", nested(60)},
            {"a strong one", with_a_strong_one(200)}};
}

} // namespace lamp_scenes
