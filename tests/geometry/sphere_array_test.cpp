#include "lib/scene/checked_scene.h"
#include "lib/scene/scene.h"
#include "lib/scene/sphere_source.h"
#include "lib/scene/srgb.h"
#include "tests/geometry/particles.h"
#include "tests/support/checked_scene_of.h"
#include "tests/support/expected_error.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <span>
#include <vector>

namespace sphere_arrays {

namespace {

// The allocation ends with the last element, so that sanitizers detect reads beyond it.
class ColumnCopy {
public:
    template <typename Number>
    ColumnCopy(const std::vector<Number> &numbers, std::uint32_t components, std::uint32_t type, std::uint32_t stride,
               std::size_t offset) {
        const std::size_t size = components * sizeof(Number);
        const std::size_t count = stride == 0 ? 1 : numbers.size() / components;
        const std::size_t end = offset + (count - 1) * stride + size;
        bytes_ = std::make_unique<unsigned char[]>(end);
        std::memset(bytes_.get(), 0xff, end);
        for (std::size_t i = 0; i < count; ++i)
            std::memcpy(bytes_.get() + offset + i * stride, numbers.data() + i * components, size);
        column_ = {bytes_.get() + offset, stride, type};
    }

    const pt_column &column() const { return column_; }

private:
    std::unique_ptr<unsigned char[]> bytes_;
    pt_column column_;
};

template <typename To, typename From>
std::vector<To> converted(const std::vector<From> &from) {
    return {from.begin(), from.end()};
}

TEST(SphereArrays, AreTheSpheresOfStructs) {
    const Particles particles;
    const std::vector<pt_sphere> spheres = particles.spheres();
    const pt::Scene expected = pt::owned_scene(checked_scene_of(scene_of(three_materials, spheres, {})));
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

TEST(SphereArrays, MayHaveTwoToTheTwentySixthSpheres) {
    Particles particles;
    particles.count = 1U << 26;
    particles.spoil = [](pt_sphere_array &array) {
        for (pt_column *column : {&array.center, &array.radius, &array.motion, &array.material, &array.color})
            column->stride_bytes = 0;
    };
    const pt_sphere_array array = particles.array();
    pt_scene scene = scene_of(three_materials, {}, {}, {&array, 1});
    const pt::CheckedScene checked = checked_scene_of(scene);
    EXPECT_EQ(checked.spheres.size(), std::size_t{1} << 26);
    EXPECT_EQ(checked.spheres[(1U << 26) - 1].radius, 1.0);
}

TEST(SphereArrays, OfNoneNeedNoColumns) {
    Particles particles;
    particles.spoil = [](pt_sphere_array &array) {
        array = {sizeof array, 0, {nullptr, 12, PT_TYPE_FLOAT32}, {nullptr, 1, 77}, {}, {}, {}, {}, {}};
    };
    EXPECT_EQ(particles.outcome(), "accepted");
    EXPECT_TRUE(particles.validated().spheres.empty());
}

std::vector<unsigned char> resized(std::span<const pt_sphere_array> arrays, std::uint32_t size) {
    std::vector<unsigned char> bytes(arrays.size() * size);
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        pt_sphere_array array = arrays[i];
        array.struct_size = size;
        std::memcpy(bytes.data() + i * size, &array, std::min<std::size_t>(size, sizeof array));
    }
    return bytes;
}

pt::Scene validated_bytes(const std::vector<unsigned char> &bytes, std::uint32_t count) {
    pt_scene scene = scene_of(three_materials, {}, {});
    scene.sphere_arrays = reinterpret_cast<const pt_sphere_array *>(bytes.data());
    scene.sphere_array_count = count;
    return pt::owned_scene(checked_scene_of(scene));
}

TEST(SphereArrays, MayBeShorterOrLonger) {
    const Particles particles;
    const std::array<pt_sphere_array, 2> arrays{particles.array(), particles.array()};
    const pt::Scene whole = validated_bytes(resized(arrays, sizeof(pt_sphere_array)), 2);
    const pt::Scene longer = validated_bytes(resized(arrays, sizeof(pt_sphere_array) + 20), 2);
    EXPECT_EQ(pt::digest_of(longer), pt::digest_of(whole));
    const pt::Scene shorter = validated_bytes(resized(arrays, offsetof(pt_sphere_array, motion)), 2);
    ASSERT_EQ(shorter.spheres.size(), 8U);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(shorter.spheres[i].center, whole.spheres[i].center);
        EXPECT_EQ(shorter.spheres[i].radius, whole.spheres[i].radius);
        EXPECT_EQ(shorter.spheres[i].motion, glm::dvec3(0));
        EXPECT_EQ(shorter.spheres[i].material, 0U);
    }
}

TEST(SphereArrays, OfOtherSizesAreRefused) {
    const Particles particles;
    const std::array<pt_sphere_array, 2> arrays{particles.array(), particles.array()};
    std::vector<unsigned char> longer = resized(arrays, sizeof(pt_sphere_array) + 8);
    longer.back() = 1;
    const pt::Error unknown = error_of([&] { validated_bytes(longer, 2); });
    EXPECT_EQ(unknown.code(), PT_ERROR_UNSUPPORTED);
    EXPECT_STREQ(unknown.what(), "sphere_arrays[1].struct_size = 128: byte 127 is set, but this library knows only the "
                                 "first 120 bytes of the struct");
    std::array<pt_sphere_array, 2> unlike = arrays;
    unlike[1].struct_size = 40;
    const pt::Error error = error_of([&] { particles.validated(unlike); });
    EXPECT_EQ(error.code(), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(error.what(), "sphere_arrays[1].struct_size = 40: must be equal to that of sphere_arrays[0] (120)");
}

TEST(SphereArrays, ColorsMultiplyTheDiffuse) {
    const Particles particles;
    const pt::Scene scene = particles.validated();
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
    EXPECT_EQ(pt::digest_of(scene), pt::digest_of(pt::owned_scene(checked_scene_of(scene_of(by_hand, spheres, {})))));
    spheres[2].material = 2;
    EXPECT_NE(pt::digest_of(scene), pt::digest_of(pt::owned_scene(checked_scene_of(scene_of(by_hand, spheres, {})))));
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
    const auto color = [&](const ColumnCopy &copy, std::uint32_t index) {
        pt_sphere_array array = particles.array();
        array.color = copy.column();
        return pt::SphereSource({}, {&array, 1})[index].look.color;
    };
    for (std::uint32_t i = 0; i < 4; ++i)
        EXPECT_EQ(color(doubles, i), color(floats, i)) << i;
    EXPECT_EQ(color(floats, 3), glm::vec3(0.25F, 0.5F, 0.75F));
    EXPECT_EQ(color(bytes, 0), glm::vec3(0, 1, pt::linear_from_srgb(10)));
    EXPECT_EQ(color(bytes, 3),
              glm::vec3(pt::linear_from_srgb(254), pt::linear_from_srgb(40), pt::linear_from_srgb(50)));
    particles.spoil = [&](pt_sphere_array &array) { array.color = doubles.column(); };
    EXPECT_EQ(particles.outcome(), "accepted");
}

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
