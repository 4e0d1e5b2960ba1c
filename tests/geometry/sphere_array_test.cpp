#include "lib/scene/checked_scene.h"
#include "lib/scene/scene.h"
#include "lib/scene/sphere_source.h"
#include "lib/scene/srgb.h"
#include "tests/geometry/particles.h"
#include "tests/support/checked_scene_of.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace sphere_arrays {

namespace {

// The allocation ends with the last element, so that sanitizers detect reads beyond it.
class ColumnCopy {
public:
    template <typename Number>
    ColumnCopy(const std::vector<Number> &numbers, std::uint32_t components, std::uint32_t type, std::uint32_t gap,
               std::size_t offset) {
        const std::size_t size = components * sizeof(Number);
        const std::size_t stride = size + gap;
        const std::size_t count = numbers.size() / components;
        const std::size_t end = offset + (count - 1) * stride + size;
        bytes_ = std::make_unique<unsigned char[]>(end);
        std::memset(bytes_.get(), 0xff, end);
        for (std::size_t i = 0; i < count; ++i)
            std::memcpy(bytes_.get() + offset + i * stride, numbers.data() + i * components, size);
        column_ = {bytes_.get() + offset, static_cast<std::uint32_t>(stride), type};
    }

    const pt_column &column() const { return column_; }

private:
    std::unique_ptr<unsigned char[]> bytes_;
    pt_column column_;
};

std::vector<double> doubles_of(const std::vector<float> &floats) {
    return {floats.begin(), floats.end()};
}

std::string digest_of(const std::vector<pt_material> &materials, const std::vector<pt_sphere> &spheres) {
    return pt::digest_of(pt::owned_scene(checked_scene_of(scene_of(materials, spheres, {}))));
}

TEST(SphereArrays, AreTheSpheresOfStructs) {
    const Particles particles;
    const std::vector<pt_sphere> spheres = particles.spheres();
    const pt::Scene expected = pt::owned_scene(checked_scene_of(scene_of(three_materials, spheres, {})));
    for (const std::uint32_t gap : {0U, 1U, 4U, 1000U})
        for (const std::size_t offset : {0U, 1U, 3U, 7U}) {
            SCOPED_TRACE(testing::Message() << "gap " << gap << ", offset " << offset);
            const ColumnCopy center(particles.center, 3, PT_TYPE_FLOAT32, gap, offset);
            const ColumnCopy center64(doubles_of(particles.center), 3, PT_TYPE_FLOAT64, gap, offset);
            const ColumnCopy radius(particles.radius, 1, PT_TYPE_FLOAT32, gap, offset);
            const ColumnCopy radius64(doubles_of(particles.radius), 1, PT_TYPE_FLOAT64, gap, offset);
            const ColumnCopy motion(particles.motion, 3, PT_TYPE_FLOAT64, gap, offset);
            const ColumnCopy material(particles.material, 1, PT_TYPE_UINT32, gap, offset);
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
                ASSERT_EQ(found.spheres.size(), 4U);
                for (std::size_t i = 0; i < 4; ++i)
                    expect_equal(found.spheres[i], expected.spheres[i]);
                EXPECT_EQ(pt::digest_of(found), pt::digest_of(expected));
            }
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
    const pt::CheckedScene checked = checked_scene_of(scene_of(three_materials, {}, {}, {&array, 1}));
    EXPECT_EQ(checked.spheres.size(), std::size_t{1} << 26);
    EXPECT_EQ(checked.spheres[(1U << 26) - 1].radius, 1.0);
}

TEST(SphereArrays, MayBeShorterOrLonger) {
    const auto read_as = [](std::uint32_t size) {
        const Particles particles;
        std::vector<unsigned char> bytes(2 * std::size_t{size});
        for (std::size_t i = 0; i < 2; ++i) {
            pt_sphere_array array = particles.array();
            array.struct_size = size;
            std::memcpy(bytes.data() + i * size, &array, std::min<std::size_t>(size, sizeof array));
        }
        pt_scene scene = scene_of(three_materials, {}, {});
        scene.sphere_arrays = reinterpret_cast<const pt_sphere_array *>(bytes.data());
        scene.sphere_array_count = 2;
        return pt::owned_scene(checked_scene_of(scene));
    };
    const pt::Scene whole = read_as(sizeof(pt_sphere_array));
    EXPECT_EQ(pt::digest_of(read_as(sizeof(pt_sphere_array) + 20)), pt::digest_of(whole));
    const pt::Scene shorter = read_as(offsetof(pt_sphere_array, motion));
    ASSERT_EQ(shorter.spheres.size(), 8U);
    for (std::size_t i = 0; i < 8; ++i)
        expect_equal(shorter.spheres[i], {whole.spheres[i].center, whole.spheres[i].radius, glm::dvec3(0), 0});
}

TEST(SphereArrays, ColorsMultiplyTheDiffuse) {
    const Particles particles;
    const pt::Scene scene = particles.validated();
    EXPECT_EQ(scene.materials.size(), 5U);
    std::vector<pt_material> by_hand = three_materials;
    by_hand.insert(by_hand.begin(), {{0, 0.25F, 0.5F}, {0.25F, 0.5F, 0}, {0, 0, 0}, 10, 0});
    by_hand.push_back({{0.1F, 0.2F, 0.3F}, {0, 0, 0}, {0, 0, 0}, 0, 0});
    std::vector<pt_sphere> spheres = particles.spheres();
    spheres[0].material = 1;
    spheres[1].material = 3;
    spheres[2].material = 4;
    spheres[3].material = 0;
    EXPECT_EQ(pt::digest_of(scene), digest_of(by_hand, spheres));
    spheres[2].material = 2;
    EXPECT_NE(pt::digest_of(scene), digest_of(by_hand, spheres));
}

TEST(SphereArrays, EqualColorsShareAMaterial) {
    constexpr std::uint32_t count = 60000;
    std::vector<std::uint8_t> bytes;
    std::mt19937 random(1);
    Particles particles;
    particles.materials = {{{1, 1, 1}, {0, 0, 0}, {0, 0, 0}, 0, 0}, {{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {0, 0, 0}, 5, 0}};
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
        const pt_material &base = particles.materials[particles.material[i]];
        ASSERT_EQ(material.glossiness, base.glossiness);
        for (int component = 0; component < 3; ++component)
            ASSERT_EQ(material.diffuse[component],
                      base.diffuse[component] * pt::linear_from_srgb(bytes[3 * i + static_cast<unsigned>(component)]));
    }
}

TEST(Srgb, IsDecodedAsTheStandardSays) {
    for (int byte = 0; byte < 256; ++byte) {
        const double encoded = byte / 255.0;
        const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        EXPECT_EQ(pt::linear_from_srgb(static_cast<std::uint8_t>(byte)), static_cast<float>(linear)) << byte;
    }
}

TEST(SphereSource, KnowsOpacitiesThatLetRaysPass) {
    const std::vector<float> center(9);
    const float radius = 0.5F;
    for (const float opacity : {0.998F, 0.9981F}) {
        pt_sphere_array array = array_of(3, {center.data(), 12, PT_TYPE_FLOAT32}, {&radius, 0, PT_TYPE_FLOAT32});
        array.opacity = {&opacity, 0, PT_TYPE_FLOAT32};
        EXPECT_EQ(pt::SphereSource({}, {&array, 1}).counts().has_opacities, opacity < 1.0F - 0.5F / 255.0F);
    }
}

TEST(SphereSource, ReadsInOrderAcrossArrays) {
    std::vector<float> center(3 * 1003);
    std::vector<float> color(3 * 1003);
    for (std::size_t i = 0; i < center.size(); ++i) {
        center[i] = static_cast<float>(i + 1);
        color[i] = static_cast<float>(i) / static_cast<float>(center.size());
    }
    const float radius = 0.5F;
    const std::vector<pt_sphere> structs(5, pt_sphere{{9, 9, 9}, 3, {1, 0, 0}, 1, 0});
    std::vector<pt::Sphere> expected(5, {{9, 9, 9}, 3, {1, 0, 0}, 1});
    std::vector<pt_sphere_array> arrays;
    for (const std::uint32_t count : {0U, 1U, 300U, 0U, 0U, 700U, 2U, 0U}) {
        const float *const at = center.data() + 3 * (expected.size() - structs.size());
        const float *const colors = color.data() + (at - center.data());
        arrays.push_back(array_of(count, {at, 12, PT_TYPE_FLOAT32}, {&radius, 0, PT_TYPE_FLOAT32}));
        if (count != 300)
            arrays.back().color = {colors, 12, PT_TYPE_FLOAT32};
        for (std::uint32_t i = 0; i < 3 * count; i += 3) {
            expected.push_back({{at[i], at[i + 1], at[i + 2]}, 0.5, {0, 0, 0}, 0});
            if (count != 300)
                expected.back().look.color = {colors[i], colors[i + 1], colors[i + 2]};
        }
    }
    const pt::SphereSource source(structs, arrays);
    ASSERT_EQ(source.size(), expected.size());
    const std::vector<std::uint32_t> starts(source.array_starts().begin(), source.array_starts().end());
    EXPECT_EQ(starts, (std::vector<std::uint32_t>{5, 5, 6, 306, 306, 306, 1006, 1008}));
    pt::WorkProgress nobody;
    std::uint32_t next = 0;
    source.for_each(nobody, [&](std::uint32_t index, const pt::Sphere &sphere) {
        ASSERT_EQ(index, next++);
        expect_equal(sphere, expected[index]);
        expect_equal(source[index], expected[index]);
    });
    EXPECT_EQ(next, source.size());

    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < source.size(); ++i)
        indices.push_back(i % 3 == 0 ? i * 401 % 1008 : 1007 - i);
    for (std::uint32_t i = 0; i < source.size(); ++i)
        indices.push_back(i);
    std::size_t read = 0;
    source.for_each(indices, nobody, [&](std::size_t i, const pt::Sphere &sphere) {
        ASSERT_EQ(i, read++);
        expect_equal(sphere, expected[indices[i]]);
    });
    EXPECT_EQ(read, indices.size());
}

TEST(Scene, KnowsWhereTheCallerHasASphere) {
    pt::Scene scene;
    scene.array_starts = {2, 2, 5};
    for (const auto &[index, expected] : {std::pair(1, "spheres 1 -1"),
                                          {2, "sphere_arrays 1 0"},
                                          {4, "sphere_arrays 1 2"},
                                          {5, "sphere_arrays 2 0"},
                                          {9, "sphere_arrays 2 4"}}) {
        const pt::SpherePlace found = pt::place_of_sphere(scene, static_cast<std::size_t>(index));
        EXPECT_EQ(std::string(found.subject) + ' ' + std::to_string(found.index) + ' ' +
                      std::to_string(found.component),
                  expected);
    }
}

} // namespace

} // namespace sphere_arrays
