// Spheres given by columns equal those given by structs, whatever the columns' types and strides.
#include "lib/scene/scene.h"
#include "lib/scene/scene_digest.h"
#include "tests/host/column_copy.h"
#include "tests/host/particles.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sphere_arrays {

namespace {

TEST(SphereArrays, AreTheSpheresOfStructs) {
    const Particles particles;
    const std::vector<pt_sphere> spheres = particles.spheres();
    const pt::Scene expected = pt::validated_scene(scene_of(three_materials, spheres, {}));
    for (const std::uint32_t gap : {0U, 1U, 4U, 1000U})
        for (const std::size_t offset : {0U, 1U, 3U, 7U}) {
            SCOPED_TRACE(testing::Message() << "gap " << gap << ", offset " << offset);
            const ColumnCopy center(particles.center, 3, PT_TYPE_FLOAT32, 12 + gap, offset);
            const ColumnCopy center64(converted<double>(particles.center), 3, PT_TYPE_FLOAT64, 24 + gap, offset);
            const ColumnCopy radius(particles.radius, 1, PT_TYPE_FLOAT32, 4 + gap, offset);
            const ColumnCopy radius64(converted<double>(particles.radius), 1, PT_TYPE_FLOAT64, 8 + gap, offset);
            const ColumnCopy motion(particles.motion, 3, PT_TYPE_FLOAT64, 24 + gap, offset);
            const ColumnCopy material(particles.material, 1, PT_TYPE_UINT32, 4 + gap, offset);
            for (const bool doubles : {false, true}) {
                Particles read;
                read.spoil = [&](pt_sphere_array &array) {
                    array.center = (doubles ? center64 : center).column();
                    array.radius = (doubles ? radius64 : radius).column();
                    array.motion = motion.column();
                    array.material = material.column();
                    array.color = {};
                };
                const pt::Scene found = read.validated();
                EXPECT_EQ(found.materials.size(), 3U);
                ASSERT_EQ(found.spheres.size(), 4U);
                for (std::size_t i = 0; i < 4; ++i)
                    expect_equal(found.spheres[i], expected.spheres[i]);
                EXPECT_EQ(pt::digest_of(found), pt::digest_of(expected));
            }
        }
}

TEST(SphereArrays, HaveOneValueForAllOrDefaults) {
    const ColumnCopy radius(std::vector<double>{0.3}, 1, PT_TYPE_FLOAT64, 0, 1);
    const ColumnCopy material(std::vector<std::uint32_t>{2}, 1, PT_TYPE_UINT32, 0, 2);
    const ColumnCopy motion(std::vector<float>{1, 2, 3}, 3, PT_TYPE_FLOAT32, 0, 3);
    Particles particles;
    particles.spoil = [&](pt_sphere_array &array) {
        array.radius = radius.column();
        array.material = material.column();
        array.motion = motion.column();
        array.color = {};
    };
    for (const pt::Sphere &sphere : particles.validated().spheres) {
        EXPECT_EQ(sphere.radius, 0.3);
        EXPECT_EQ(sphere.material, 2U);
        EXPECT_EQ(sphere.motion, glm::dvec3(1, 2, 3));
    }
    particles.spoil = [&](pt_sphere_array &array) { array.motion = array.material = array.color = {}; };
    for (const pt::Sphere &sphere : particles.validated().spheres) {
        EXPECT_EQ(sphere.material, 0U);
        EXPECT_EQ(sphere.motion, glm::dvec3(0));
    }
}

} // namespace

} // namespace sphere_arrays
