// Colors of spheres that are given by columns: materials of their own, shared where they are equal.
#include "lib/scene/scene.h"
#include "lib/scene/scene_digest.h"
#include "lib/scene/sphere_source.h"
#include "lib/scene/srgb.h"
#include "tests/host/column_copy.h"
#include "tests/host/particles.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace sphere_arrays {

namespace {

TEST(SphereArrays, ColorsMultiplyTheDiffuse) {
    const Particles particles;
    const pt::Scene scene = particles.validated();
    // The first sphere has its material's own color, and that of the second reflects nothing, whatever its color.
    ASSERT_EQ(scene.materials.size(), 5U);
    EXPECT_EQ(scene.spheres[0].material, 0U);
    EXPECT_EQ(scene.spheres[1].material, 2U);
    const pt::Material &third = scene.materials[scene.spheres[2].material];
    EXPECT_EQ(third.diffuse, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(third.glossiness, 0.0F);
    const pt::Material &fourth = scene.materials[scene.spheres[3].material];
    EXPECT_EQ(fourth.diffuse, glm::vec3(0, 0.25F, 0.5F));
    EXPECT_EQ(fourth.specular, glm::vec3(0.25F, 0.5F, 0));
    EXPECT_EQ(fourth.emission, glm::vec3(0));
    EXPECT_EQ(fourth.glossiness, 10.0F);

    std::vector<pt_material> by_hand = three_materials;
    by_hand.insert(by_hand.begin(), {{0, 0.25F, 0.5F}, {0.25F, 0.5F, 0}, {0, 0, 0}, 10, 0});
    by_hand.push_back({{0.1F, 0.2F, 0.3F}, {0, 0, 0}, {0, 0, 0}, 0, 0});
    std::vector<pt_sphere> spheres = particles.spheres();
    spheres[0].material = 1;
    spheres[1].material = 3;
    spheres[2].material = 4;
    spheres[3].material = 0;
    EXPECT_EQ(pt::digest_of(scene), pt::digest_of(pt::validated_scene(scene_of(by_hand, spheres, {}))));
    spheres[2].material = 2;
    EXPECT_NE(pt::digest_of(scene), pt::digest_of(pt::validated_scene(scene_of(by_hand, spheres, {}))));
}

TEST(SphereArrays, EqualColorsShareAMaterial) {
    constexpr std::uint32_t count = 60000;
    std::vector<std::uint8_t> bytes;
    std::vector<pt_material> by_hand{{{1, 1, 1}, {0, 0, 0}, {0, 0, 0}, 0, 0},
                                     {{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {0, 0, 0}, 5, 0}};
    std::mt19937 random(1);
    Particles particles;
    particles.materials = by_hand;
    particles.material.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
        for (int component = 0; component < 3; ++component)
            bytes.push_back(static_cast<std::uint8_t>(random() % 12 + 244));
        particles.material.push_back(random() % 2);
    }
    particles.count = count;
    particles.spoil = [&](pt_sphere_array &array) {
        array.center.stride_bytes = array.radius.stride_bytes = 0;
        array.motion = {};
        array.color = {bytes.data(), 3, PT_TYPE_SRGB8};
    };
    const pt::Scene scene = particles.validated();
    // 12^3 colors of two materials, of which white is there already; all of them turn up.
    EXPECT_EQ(scene.materials.size(), 2 * 12 * 12 * 12U);
    for (std::uint32_t i = 0; i < count; ++i) {
        const pt::Material &material = scene.materials[scene.spheres[i].material];
        const pt_material &base = by_hand[particles.material[i]];
        ASSERT_EQ(material.glossiness, base.glossiness);
        for (int component = 0; component < 3; ++component)
            ASSERT_EQ(material.diffuse[component],
                      base.diffuse[component] * pt::linear_from_srgb(bytes[3 * i + static_cast<unsigned>(component)]));
    }
}

TEST(SphereArrays, ColorsMayBeOfAnyType) {
    const std::vector<double> shares{0, 1, 0.1, 0.7, 0.2, 0.9, -0.0, 1, 1, 0.25, 0.5, 0.75};
    const ColumnCopy doubles(shares, 3, PT_TYPE_FLOAT64, 25, 1);
    const ColumnCopy floats(converted<float>(shares), 3, PT_TYPE_FLOAT32, 13, 3);
    const ColumnCopy bytes(std::vector<std::uint8_t>{0, 255, 10, 11, 128, 200, 1, 2, 3, 254, 40, 50}, 3, PT_TYPE_SRGB8,
                           5, 1);
    Particles particles;
    const auto color = [&](const ColumnCopy &copy, std::size_t index) {
        pt_sphere_array array = particles.array();
        array.color = copy.column();
        return pt::SphereSource({}, {&array, 1}).color(index);
    };
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(color(doubles, i), color(floats, i)) << i;
    EXPECT_EQ(color(floats, 3), glm::vec3(0.25F, 0.5F, 0.75F));
    EXPECT_EQ(color(bytes, 0), glm::vec3(0, 1, pt::linear_from_srgb(10)));
    EXPECT_EQ(color(bytes, 3),
              glm::vec3(pt::linear_from_srgb(254), pt::linear_from_srgb(40), pt::linear_from_srgb(50)));
    particles.spoil = [&](pt_sphere_array &array) { array.color = doubles.column(); };
    EXPECT_EQ(particles.outcome(), "accepted");
}

// IEC 61966-2-1, whose power is correct to a few roundings of doubles: one of float is 2^29 times as large.
TEST(Srgb, IsDecodedAsTheStandardSays) {
    for (int byte = 0; byte < 256; ++byte) {
        const double encoded = byte / 255.0;
        const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        EXPECT_EQ(pt::linear_from_srgb(static_cast<std::uint8_t>(byte)), static_cast<float>(linear)) << byte;
    }
    EXPECT_EQ(pt::linear_from_srgb(0), 0.0F);
    EXPECT_EQ(pt::linear_from_srgb(255), 1.0F);
}

} // namespace

} // namespace sphere_arrays
