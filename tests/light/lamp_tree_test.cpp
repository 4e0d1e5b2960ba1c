#include "lib/view/lamp_tree.h"
#include "lib/view/lamp_tree_words.h"
#include "lib/view/scene_blocks.h"
#include "tests/support/lamp_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace {

namespace gpu = pt::gpu;

TEST(LampTreeShape, HasASlotForEachLampAndMostAreTaken) {
    for (std::uint32_t count = 1; count < 70000; count += 1 + count / 7) {
        const pt::LampTreeShape shape(count);
        EXPECT_GE(shape.slots(), count);
        if (count > 16) {
            EXPECT_LT(shape.slots(), 2 * std::uint64_t{count}) << count;
        }
        EXPECT_LE(shape.top_groups(), gpu::LAMP_TREE_TOP_GROUPS);
        EXPECT_EQ(shape.top_groups(), gpu::lamp_tree_top_groups(count, shape.levels()));
        EXPECT_EQ(shape.first_lamp(0), 0U);
        EXPECT_EQ(shape.first_lamp(shape.slots()), count);
        std::uint64_t groups = 0;
        for (std::uint32_t level = 0; level <= shape.levels(); ++level) {
            EXPECT_EQ(shape.groups_above(level), groups);
            groups += shape.groups_of(level);
        }
        EXPECT_EQ(shape.all_groups(), groups);
        EXPECT_EQ(gpu::lamp_tree_groups(count, shape.levels()), groups);
        for (std::uint64_t slot = 0; slot < shape.slots(); ++slot)
            ASSERT_LE(shape.first_lamp(slot + 1) - shape.first_lamp(slot), 1U) << "one lamp to a slot";
        for (std::uint64_t node = 0; node < shape.slots(); node += 4)
            if (count >= 16) {
                ASSERT_GT(shape.first_lamp(node + 4), shape.first_lamp(node)) << "no group of slots is empty";
            }
    }
}

TEST(LampTreeOrder, HasEveryLampOnceAndNeighboursTogether) {
    pt::Scene scene;
    scene.materials.push_back({glm::vec3(0.5F), glm::vec3(0), glm::vec3(0), 0});
    for (int i = 0; i < 256; ++i) {
        const int heap = i % 16;
        const glm::dvec3 middle(100 * (heap % 4), 0, 100 * (heap / 4));
        lamp_scenes::add_lamp(scene, middle + glm::dvec3(i / 16 % 4, 0, i / 64), 0.25, 1);
        scene.spheres.push_back({{i, 50, 0}, 0.25, glm::dvec3(0), 0});
    }
    const std::vector<std::uint32_t> order = pt::order_in_lamp_tree(scene);
    ASSERT_EQ(order.size(), 256U);
    std::vector<std::uint32_t> sorted = order;
    std::ranges::sort(sorted);
    for (std::uint32_t i = 0; i < 256; ++i)
        EXPECT_EQ(sorted[i], 2 * i);
    for (std::size_t i = 0; i < 256; ++i)
        EXPECT_EQ(order[i] / 2 % 16, order[i / 16 * 16] / 2 % 16) << "a heap is a node";
    EXPECT_TRUE(pt::order_in_lamp_tree({}).empty());
}

struct HeldNode {
    glm::vec3 open, way;
    float power, spread;

    glm::vec3 at(float time) const { return open + time * way; }
};

HeldNode held_node(const pt::View &scene, std::uint64_t group, int place) {
    const bool motion = scene.features[gpu::ID_MOTION];
    const std::uint64_t first = pt::SceneBlocks(scene.features).lamp_tree;
    const auto number = [&](std::uint64_t word) {
        return scene.words[first + gpu::lamp_tree_group_words(motion ? 1 : 0) * group + word][place];
    };
    HeldNode node{{number(0), number(1), number(2)}, glm::vec3(0), number(3), number(4)};
    if (motion)
        node.way = {number(5), number(6), number(7)};
    return node;
}

std::uint64_t first_slot_word(const pt::View &scene) {
    return pt::SceneBlocks(scene.features).lamp_tree +
           gpu::lamp_tree_group_words(scene.features[gpu::ID_MOTION]) *
               pt::LampTreeShape(scene.features[gpu::ID_LAMP_COUNT]).all_groups();
}

std::uint32_t lamp_of_slot(const pt::View &scene, std::uint64_t slot) {
    const float bits = scene.words[first_slot_word(scene) + slot / 4][static_cast<int>(slot % 4)];
    EXPECT_TRUE(std::isnormal(bits));
    return std::bit_cast<std::uint32_t>(bits) - gpu::MATERIAL_INDEX_BITS;
}

TEST(LampTreeWords, NodesHoldTheirLamps) {
    for (const auto &[name, scene] : lamp_scenes::all()) {
        pt::Camera camera = lamp_scenes::camera();
        for (const glm::dvec3 &from : {glm::dvec3(0, 0, 0), glm::dvec3(-3e4, 17, 5e3)}) {
            camera.position = from;
            const pt::View seen = lamp_scenes::view_of(scene, camera);
            ASSERT_TRUE(seen.features[gpu::ID_LAMP_TREE_LEVELS]) << name;
            const pt::LampTreeShape shape(seen.features[gpu::ID_LAMP_COUNT]);
            const std::uint64_t slots = first_slot_word(seen) + shape.slots() / 4;
            for (std::uint32_t lamp = 0; lamp < seen.features[gpu::ID_LAMP_COUNT]; ++lamp) {
                const float bits = seen.words[slots + lamp / 4][static_cast<int>(lamp % 4)];
                EXPECT_TRUE(std::isnormal(bits));
                const std::uint64_t slot = std::bit_cast<std::uint32_t>(bits) - gpu::MATERIAL_INDEX_BITS;
                ASSERT_LT(slot, shape.slots());
                const HeldNode leaf =
                    held_node(seen, shape.groups_above(shape.levels()) + slot / 4, static_cast<int>(slot % 4));
                ASSERT_EQ(lamp_of_slot(seen, slot), lamp) << name;
                EXPECT_EQ(glm::vec4(leaf.open, leaf.spread), seen.words[lamp]);
                for (std::uint32_t level = 0; level < shape.levels(); ++level) {
                    const std::uint64_t place = slot >> (2 * (shape.levels() - level));
                    const HeldNode node =
                        held_node(seen, shape.groups_above(level) + place / 4, static_cast<int>(place % 4));
                    EXPECT_GE(node.power, leaf.power) << name;
                    for (const float time : {0.0F, 0.3F, 0.5F, 0.8F, 1.0F})
                        EXPECT_LE(glm::length(glm::dvec3(leaf.at(time)) - glm::dvec3(node.at(time))) +
                                      double{leaf.spread},
                                  8.0 * std::sqrt(double{node.spread}))
                            << name << ", lamp " << lamp << ", level " << level << ", time " << time;
                }
            }
        }
    }
}

TEST(LampTreeFeature, DependsOnTheNumberOfLampsAlone) {
    const auto features = [](const pt::Scene &scene, std::uint32_t estimator = PT_ESTIMATOR_MIS) {
        return lamp_scenes::view_of(scene, lamp_scenes::camera(), estimator).features;
    };
    constexpr std::uint32_t least = pt::least_tree_lamps;
    const pt::Features below = features(lamp_scenes::in_a_box(least - 1, 4));
    EXPECT_EQ(below[gpu::ID_LAMP_TREE_LEVELS], 0U);
    EXPECT_EQ(below[gpu::ID_LAMP_TREE_WORDS], 0U);
    EXPECT_EQ(pt::SceneBlocks(below).lamp_tree, pt::SceneBlocks(below).index);
    EXPECT_EQ(pt::loop_trips_per_sample(below), 1U + 31 + 62 + 2 * 2 * (1 + 62 + 31));

    const pt::Features from = features(lamp_scenes::in_a_box(least, 4));
    EXPECT_EQ(from[gpu::ID_LAMP_TREE_LEVELS], 1U);
    EXPECT_EQ(from[gpu::ID_LAMP_TREE_WORDS], 5 * (2 + 8) + 8 + 8U);
    EXPECT_EQ(pt::loop_trips_per_sample(from), 1U + 32 + 6 + 2 * 2 * (1 + 6 + 32));
    EXPECT_FALSE(features(lamp_scenes::in_a_box(least, 4), PT_ESTIMATOR_BSDF)[gpu::ID_LAMP_TREE_LEVELS]);
    EXPECT_TRUE(features(lamp_scenes::in_a_box(least, 4), PT_ESTIMATOR_LIGHT)[gpu::ID_LAMP_TREE_LEVELS]);
    EXPECT_EQ(features(lamp_scenes::in_a_box(200, 1)), features(lamp_scenes::in_clusters(200)));
}

TEST(LampTreeWords, LeaveOutTwins) {
    pt::Scene scene = lamp_scenes::in_a_box(40, 4);
    scene.spheres[7] = scene.spheres[31];
    const pt::View seen = lamp_scenes::view_of(scene);
    ASSERT_EQ(seen.features[gpu::ID_LAMP_COUNT], 39U);
    const pt::LampTreeShape shape(39);
    std::vector<std::uint32_t> lamps;
    for (std::uint64_t slot = 0; slot < shape.slots(); ++slot)
        if (const HeldNode leaf =
                held_node(seen, shape.groups_above(shape.levels()) + slot / 4, static_cast<int>(slot % 4));
            leaf.power > 0.0F)
            lamps.push_back(lamp_of_slot(seen, slot));
    std::ranges::sort(lamps);
    ASSERT_EQ(lamps.size(), 39U);
    EXPECT_EQ(lamps.front(), 0U);
    EXPECT_EQ(lamps.back(), 38U);
    EXPECT_EQ(std::ranges::adjacent_find(lamps), lamps.end());
}

TEST(LampTreeWords, NodesMoveWithTheirLamps) {
    pt::Scene scene = lamp_scenes::in_a_box(90, 4);
    for (pt::Sphere &sphere : scene.spheres)
        sphere.motion = {4, -2, 8};
    const pt::View seen = lamp_scenes::view_of(scene);
    const pt::LampTreeShape shape(90);
    for (std::uint64_t group = 0; group < shape.groups_above(shape.levels()); ++group)
        for (int place = 0; place < 4; ++place)
            EXPECT_LT(glm::length(held_node(seen, group, place).way - glm::vec3(2, -1, 4)), 1e-6F)
                << "the shutter is open for half of the unit of time";
}

} // namespace
