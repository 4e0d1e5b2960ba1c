#pragma once

#include "tests/support/coursework_scene.h"
#include "tests/support/scene_of.h"

#include <cstdint>
#include <random>
#include <vector>

namespace first_hits {

struct Given {
    std::vector<pt_material> materials;
    std::vector<pt_sphere> spheres;
    std::vector<pt_plane> planes;
    pt_camera camera = CourseworkScene::camera();

    pt_scene scene() const { return scene_of(materials, spheres, planes); }
};

inline std::vector<pt_material> some_materials() {
    return {{{0.8F, 0.4F, 0.2F}, {0.1F, 0.2F, 0.3F}, {0, 0, 0}, 7, 0},
            {{0.9F, 0.1F, 0}, {0.3F, 0, 0}, {0, 0, 0}, 0, 0},
            {{0.25F, 0.5F, 0.75F}, {0, 0, 0}, {30, 20, 10}, 0, 0}};
}

inline Given coursework() {
    const CourseworkScene scene;
    return {{scene.materials.begin(), scene.materials.end()},
            {scene.spheres.begin(), scene.spheres.end()},
            {scene.planes.begin(), scene.planes.end()}};
}

inline Given many(bool moves) {
    Given given;
    given.materials = some_materials();
    std::mt19937 random(5);
    const auto share = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
    for (std::uint32_t i = 0; i < 400; ++i) {
        pt_sphere sphere{
            {6 * share() - 3, 4 * share() - 2, -4 - 6 * share()}, 0.05 + 0.3 * share(), {0, 0, 0}, i % 3, 0};
        if (moves && i % 2 == 0)
            sphere.motion[0] = share() - 0.5;
        given.spheres.push_back(sphere);
    }
    given.spheres.insert(given.spheres.begin() + 100, {{0, -1e6 - 3, 0}, 1e6, {0, 0, 0}, 1, 0});
    given.planes = {{{0, 0, 1}, 12, 0, 0}, {{1, 0, 0.1}, 7, 2, 0}};
    given.camera.shutter_close = 0.5;
    return given;
}

} // namespace first_hits
