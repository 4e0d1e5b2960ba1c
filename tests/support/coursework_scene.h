#pragma once

#include "tests/support/scene_of.h"

#include <pt/pt.h>

#include <array>
#include <cmath>

struct CourseworkScene {
    std::array<pt_material, 7> materials = {{
        {{0, 0, 0}, {0, 0, 0}, {135, 135, 75}, 0, 0},
        {{0, 0, 0}, {0, 0, 0}, {120, 45, 15}, 0, 0},
        {{0.2F, 0.5F, 0.8F}, {0.8F, 0.8F, 0.8F}, {0, 0, 0}, 40, 0},
        {{0.9F, 0.8F, 0.8F}, {1.0F, 1.0F, 1.0F}, {0, 0, 0}, 10, 0},
        {{0.8F, 0.8F, 0.8F}, {0, 0, 0}, {0, 0, 0}, 0, 0},
        {{0.9F, 0.6F, 0.3F}, {0.02F, 0.02F, 0.02F}, {0, 0, 0}, 3000, 0},
        {{0.2F, 0.2F, 0.2F}, {0.1F, 0.1F, 0.1F}, {0, 0, 0}, 100, 0},
    }};
    std::array<pt_sphere, 4> spheres = {{
        {{7, -2, -12}, 2, {0, 0, 0}, 0, 0},
        {{-8, 4, -13}, 1, {0, 0, 0}, 1, 0},
        {{-2, -2, -12}, 3, {0, 0, 0}, 2, 0},
        {{3, -3.5, -14}, 1, {0, 0, 0}, 3, 0},
    }};
    std::array<pt_plane, 4> planes = {{
        {{0, 1, 0}, 4.5, 4, 0},
        {{0, 0, 1}, 18.5, 5, 0},
        {{1, 0, 0}, 10, 6, 0},
        {{-1, 0, 0}, 10, 6, 0},
    }};

    void make_diffuse() {
        for (pt_material &material : materials)
            material.specular[0] = material.specular[1] = material.specular[2] = material.glossiness = 0;
    }

    pt_scene scene() const { return scene_of(materials, spheres, planes); }

    // The camera is at (0, 0, 1) and looks at the origin. The image plane's height equals its distance.
    static pt_camera camera() { return camera_at({0, 0, 1}, {0, 0, 0}, 2 * std::atan(0.5)); }
};
