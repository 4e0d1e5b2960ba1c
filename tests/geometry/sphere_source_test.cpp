#include "lib/scene/scene.h"
#include "lib/scene/sphere_source.h"
#include "lib/tree/tree_choice.h"
#include "tests/geometry/particles.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sphere_arrays {

namespace {

TEST(SphereSource, ReadsInOrderAcrossArrays) {
    std::vector<float> center(3 * 2000);
    std::vector<float> color(3 * 2000);
    for (std::size_t i = 0; i < center.size(); ++i) {
        center[i] = static_cast<float>(i + 1);
        color[i] = static_cast<float>(i) / static_cast<float>(center.size());
    }
    const float radius = 0.5F;
    std::vector<pt_sphere_array> arrays;
    std::size_t first = 0;
    for (const std::uint32_t count : {0U, 1U, 300U, 0U, 0U, 700U, 2U, 0U}) {
        pt_sphere_array array =
            array_of(count, {&center[3 * first], 12, PT_TYPE_FLOAT32}, {&radius, 0, PT_TYPE_FLOAT32});
        if (count != 300)
            array.color = {&color[3 * first], 12, PT_TYPE_FLOAT32};
        arrays.push_back(array);
        first += count;
    }
    const std::vector<pt_sphere> structs(5, pt_sphere{{9, 9, 9}, 3, {1, 0, 0}, 1, 0});
    const pt::SphereSource source(structs, arrays);
    ASSERT_EQ(source.size(), 5 + first);
    EXPECT_TRUE(source.has(&pt_sphere_array::color));
    EXPECT_FALSE(source.has(&pt_sphere_array::end));
    std::uint32_t next = 0;
    std::vector<glm::vec3> colors;
    pt::WorkProgress nobody;
    source.for_each(nobody, [&](std::uint32_t index, const pt::Sphere &sphere) {
        const glm::vec3 own_color = sphere.look.color;
        ASSERT_EQ(index, next++);
        expect_equal(sphere, source[index]);
        colors.push_back(own_color);
        if (index < 5) {
            expect_equal(sphere, {{9, 9, 9}, 3, {1, 0, 0}, 1});
            EXPECT_EQ(own_color, glm::vec3(1));
            return;
        }
        const float *at = &center[3 * (index - 5)];
        expect_equal(sphere, {{at[0], at[1], at[2]}, 0.5, {0, 0, 0}, 0});
        const float *shade = &color[3 * (index - 5)];
        const bool is_colored = index < 6 || index >= 306;
        EXPECT_EQ(own_color, is_colored ? glm::vec3(shade[0], shade[1], shade[2]) : glm::vec3(1)) << index;
    });
    EXPECT_EQ(next, source.size());
    const std::vector<std::uint32_t> starts(source.array_starts().begin(), source.array_starts().end());
    EXPECT_EQ(starts, (std::vector<std::uint32_t>{5, 5, 6, 306, 306, 306, 1006, 1008}));

    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < source.size(); ++i)
        indices.push_back(i % 3 == 0 ? i * 401 % 1008 : 1007 - i);
    for (std::uint32_t i = 0; i < source.size(); ++i)
        indices.push_back(i);
    std::size_t read = 0;
    source.for_each(indices, nobody, [&](std::size_t i, const pt::Sphere &sphere) {
        ASSERT_EQ(i, read++);
        expect_equal(sphere, source[indices[i]]);
        EXPECT_EQ(sphere.look.color, colors[indices[i]]) << indices[i];
    });
    EXPECT_EQ(read, indices.size());
}

TEST(TreeChoice, KnowsWhichMaterialsAreUsed) {
    const std::vector<float> center(3 * 4);
    const std::vector<std::uint32_t> materials = {7, 5, 7, 5};
    const std::uint32_t one = 3;
    const std::uint32_t nobodys = 2;
    const auto array = [&](std::uint32_t count, pt_column material) {
        pt_sphere_array columns =
            array_of(count, {center.data(), 12, PT_TYPE_FLOAT32}, {center.data(), 0, PT_TYPE_FLOAT32});
        columns.material = material;
        return columns;
    };
    const auto used_by = [](std::span<const pt_sphere> structs, std::span<const pt_sphere_array> arrays) {
        pt::WorkProgress nobody;
        const std::vector<bool> used =
            pt::tree_choice(pt::SphereSource(structs, arrays), std::vector<pt::Material>(9), nobody).used_materials;
        std::vector<std::size_t> marked;
        for (std::size_t i = 0; i < used.size(); ++i)
            if (used[i])
                marked.push_back(i);
        return marked;
    };
    using Marked = std::vector<std::size_t>;
    const std::vector<pt_sphere> structs(2, pt_sphere{{9, 9, 9}, 3, {1, 0, 0}, 1, 0});
    const std::vector<pt_sphere_array> arrays = {array(4, {materials.data(), 4, PT_TYPE_UINT32}),
                                                 array(4, {&one, 0, PT_TYPE_UINT32}),
                                                 array(0, {&nobodys, 0, PT_TYPE_UINT32})};
    EXPECT_EQ(used_by(structs, {}), Marked{1});
    EXPECT_EQ(used_by(structs, arrays), (Marked{1, 3, 5, 7}));
    const pt_sphere_array without = array(4, {});
    EXPECT_EQ(used_by({}, {&without, 1}), Marked{0});
}

TEST(Scene, KnowsWhereTheCallerHasASphere) {
    pt::Scene scene;
    scene.array_starts = {2, 2, 5};
    const auto place = [&](std::size_t index) {
        const pt::SpherePlace found = pt::place_of_sphere(scene, index);
        return std::string(found.subject) + ' ' + std::to_string(found.index) + ' ' + std::to_string(found.component);
    };
    EXPECT_EQ(place(0), "spheres 0 -1");
    EXPECT_EQ(place(1), "spheres 1 -1");
    EXPECT_EQ(place(2), "sphere_arrays 1 0");
    EXPECT_EQ(place(4), "sphere_arrays 1 2");
    EXPECT_EQ(place(5), "sphere_arrays 2 0");
    EXPECT_EQ(place(9), "sphere_arrays 2 4");
}

TEST(SphereSource, KnowsOpacitiesThatLetRaysPass) {
    const std::vector<float> center{0, 0, 0, 4, 0, 0, 8, 0, 0};
    const float radius = 1.0F;
    const auto read = [&](const std::vector<float> &opacities) {
        pt_sphere_array array = array_of(3, {center.data(), 12, PT_TYPE_FLOAT32}, {&radius, 0, PT_TYPE_FLOAT32});
        array.opacity = {opacities.data(), opacities.size() == 1 ? 0U : 4U, PT_TYPE_FLOAT32};
        const pt::SphereSource source({}, {&array, 1});
        return std::pair(source.counts().has_opacities, source[1].opacity);
    };
    EXPECT_EQ(read({1.0F, 1.0F, 1.0F}), std::pair(false, pt::no_opacity));
    EXPECT_EQ(read({0.9999F}), std::pair(false, pt::no_opacity));
    EXPECT_EQ(read({0.9981F, 0.9999F, 1.0F}), std::pair(false, pt::no_opacity));
    EXPECT_EQ(read({0.998F, 0.9999F, 1.0F}), std::pair(true, pt::opaque));
    EXPECT_EQ(read({1.0F, 0.5F, 1.0F}), std::pair(true, std::int16_t{128}));
    EXPECT_EQ(read({0.0F}), std::pair(true, std::int16_t{0}));
}

} // namespace

} // namespace sphere_arrays
