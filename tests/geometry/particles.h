#pragma once

#include "lib/scene/checked_scene.h"
#include "tests/support/checked_scene_of.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace sphere_arrays {

inline const std::vector<pt_material> three_materials = {{{0.5F, 0.25F, 1.0F}, {0.25F, 0.5F, 0}, {0, 0, 0}, 10, 0},
                                                         {{1, 1, 1}, {0, 0, 0}, {0, 0, 0}, 0, 0},
                                                         {{0, 0, 0}, {0, 0, 0}, {2, 3, 4}, 0, 0}};

struct Particles {
    std::vector<float> center = {1, 2, 3, 4, 5, 6, -7, 8, 9, 10, 11, -0.0F};
    std::vector<float> radius = {1, 2, 0.1F, 4};
    std::vector<double> motion = {0, 0, 0, 0, 1, 0, 0.1, 0, 0, 0, 0, -1e-3};
    std::vector<std::uint32_t> material = {0, 2, 1, 0};
    std::vector<float> color = {1, 1, 1, 0.5F, 0.5F, 0.5F, 0.1F, 0.2F, 0.3F, 0, 1, 0.5F};
    std::vector<pt_material> materials = three_materials;
    std::uint32_t count = 4;
    std::function<void(pt_sphere_array &)> spoil = [](pt_sphere_array &) {};
    std::function<void(pt_scene &)> spoil_scene = [](pt_scene &) {};

    pt_sphere_array array() const {
        pt_sphere_array array =
            array_of(count, {center.data(), 12, PT_TYPE_FLOAT32}, {radius.data(), 4, PT_TYPE_FLOAT32});
        array.motion = {motion.data(), 24, PT_TYPE_FLOAT64};
        array.material = {material.data(), 4, PT_TYPE_UINT32};
        array.color = {color.data(), 12, PT_TYPE_FLOAT32};
        spoil(array);
        return array;
    }

    std::vector<pt_sphere> spheres() const {
        std::vector<pt_sphere> spheres;
        for (std::size_t i = 0; i < count; ++i)
            spheres.push_back({{center[3 * i], center[3 * i + 1], center[3 * i + 2]},
                               radius[i],
                               {motion[3 * i], motion[3 * i + 1], motion[3 * i + 2]},
                               material[i],
                               0});
        return spheres;
    }

    pt::Scene validated() const {
        const std::array<pt_sphere_array, 1> arrays{array()};
        return validated(arrays);
    }

    pt::Scene validated(std::span<const pt_sphere_array> arrays) const {
        pt_scene scene = scene_of(materials, {}, {}, arrays);
        spoil_scene(scene);
        return pt::owned_scene(checked_scene_of(scene));
    }
};

inline void expect_equal(const pt::Sphere &a, const pt::Sphere &b) {
    EXPECT_EQ(a.center, b.center);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.motion, b.motion);
    EXPECT_EQ(a.material, b.material);
    EXPECT_EQ(a.look.color, b.look.color);
}

} // namespace sphere_arrays
