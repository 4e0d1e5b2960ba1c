#include "lamps.spv.h"
#include "lib/view/scene_blocks.h"
#include "lib/view/view.h"
#include "shaders/specialization.h"
#include "tests/kernel/probe.h"
#include "tests/support/lamp_scenes.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace {

struct TreeVertex {
    glm::vec3 position;
    glm::vec3 normal;
    float time = 0.0F;
    std::uint32_t surface = 0xffffffffU;
};

struct TreeDrawn {
    glm::vec3 direction;
    float distance;
    std::uint32_t lamp;
    float density;
    float hit_density;
    float probability;
};

class TreeProbe {
public:
    explicit TreeProbe(const pt::View &scene) :
        lamp_count_(scene.features[pt::gpu::ID_LAMP_COUNT]),
        probe_(lamps_spirv(), sizeof(Push), constants(scene)) {
        probe_.set_scene(scene.words);
    }

    std::vector<TreeDrawn> draw(const TreeVertex &vertex, std::uint32_t count, std::uint32_t seed = 1) {
        const Push push{glm::vec4(vertex.position, 0), glm::vec4(vertex.normal, vertex.time), vertex.surface, seed,
                        lamp_count_ + count};
        return probe_.run<TreeDrawn>({}, push.count, push, push.count);
    }

    std::vector<double> probabilities(const TreeVertex &vertex) {
        std::vector<double> result;
        for (const TreeDrawn &stated : draw(vertex, 0))
            result.push_back(static_cast<double>(stated.probability));
        return result;
    }

private:
    struct Push {
        glm::vec4 position, normal_time;
        std::uint32_t surface, seed, count;
    };

    static std::array<std::uint32_t, pt::gpu::CONSTANT_COUNT> constants(const pt::View &scene) {
        auto constants = pt::specialization_constants(scene.features);
        constants[pt::gpu::ID_POINT_BLOCKS] = probe_point_blocks;
        return constants;
    }

    std::uint32_t lamp_count_;
    Probe probe_;
};

std::vector<TreeVertex> tree_vertices(const pt::View &scene) {
    const glm::vec3 lamp(scene.words[scene.features[pt::gpu::ID_LAMP_COUNT] / 2]);
    const float radius = scene.words[scene.features[pt::gpu::ID_LAMP_COUNT] / 2].w;
    const glm::vec3 oblique = glm::normalize(glm::vec3(2, -1, 0.5F));
    return {{{0, 0, 0}, {0, 1, 0}, 0.0F},
            {{7, 0, -3}, {0, 1, 0}, 0.375F},
            {{-4, 3, 2}, oblique, 1.0F},
            {{1, 5, -6}, {0, -1, 0}, 0.5F},
            {{0, -50, 0}, {0, 1, 0}, 0.25F},
            {{0, -50, 0}, {0, -1, 0}, 0.25F},
            {{400, 300, 5}, -glm::normalize(glm::vec3(4, 3, 0)), 0.75F},
            {lamp + 1.5F * radius * glm::vec3(0, 0, 1), {0, 0.6F, -0.8F}, 0.0F},
            {lamp, {0, 0, 1}, 0.0F, scene.features[pt::gpu::ID_LAMP_COUNT] / 2}};
}

std::vector<double> lamp_weights(const pt::View &scene, const TreeVertex &vertex) {
    std::vector<double> weights;
    const pt::SceneBlocks blocks(scene.features);
    for (std::uint32_t lamp = 0; lamp < scene.features[pt::gpu::ID_LAMP_COUNT]; ++lamp) {
        glm::dvec3 to = glm::dvec3(glm::vec3(scene.words[lamp])) - glm::dvec3(vertex.position);
        if (scene.features[pt::gpu::ID_MOTION])
            to += double{vertex.time} * glm::dvec3(glm::vec3(scene.words[blocks.motion + lamp]));
        const double radius = double{scene.words[lamp].w};
        const double distance = glm::length(to);
        const double cosine = std::min(1.0, (glm::dot(to, glm::dvec3(vertex.normal)) + radius) / distance);
        const bool sampled = distance > radius && cosine > 0.0 && lamp != vertex.surface;
        const double radiance = double{scene.words[blocks.emission + lamp].w};
        weights.push_back(sampled ? radiance * std::pow(radius / distance, 2) * cosine : 0.0);
    }
    return weights;
}

// Lamps with fewer than 20 expected choices are counted together.
struct Frequencies {
    std::vector<double> observed, expected, wrong;
};

Frequencies frequencies(const std::vector<TreeDrawn> &drawn, std::uint32_t lamp_count) {
    std::vector<double> counts(lamp_count);
    for (std::size_t i = lamp_count; i < drawn.size(); ++i)
        ++counts.at(drawn[i].lamp);
    const auto total = static_cast<double>(drawn.size() - lamp_count);
    Frequencies cells;
    std::array<double, 3> rest{};
    bool is_up = false;
    for (std::uint32_t lamp = 0; lamp < lamp_count; ++lamp) {
        const double expected = total * static_cast<double>(drawn[lamp].probability);
        is_up = !is_up;
        const std::array<double, 3> cell = {counts[lamp], expected, expected * (is_up ? 1.1 : 0.9)};
        if (expected < 20.0) {
            for (std::size_t i = 0; i < 3; ++i)
                rest[i] += cell[i];
            continue;
        }
        cells.observed.push_back(cell[0]);
        cells.expected.push_back(cell[1]);
        cells.wrong.push_back(cell[2]);
    }
    if (rest[1] >= 20.0) {
        cells.observed.push_back(rest[0]);
        cells.expected.push_back(rest[1]);
        cells.wrong.push_back(rest[2]);
    }
    return cells;
}

void expect_what_is_stated(const std::vector<TreeDrawn> &drawn, const std::vector<double> &weights) {
    for (std::size_t i = weights.size(); i < drawn.size(); ++i) {
        const TreeDrawn &sample = drawn[i];
        ASSERT_LT(sample.lamp, weights.size());
        ASSERT_EQ(std::bit_cast<std::uint32_t>(sample.probability),
                  std::bit_cast<std::uint32_t>(drawn[sample.lamp].probability))
            << "lamp " << sample.lamp;
        ASSERT_TRUE(std::isfinite(sample.density) && std::isfinite(sample.probability));
        ASSERT_EQ(sample.density > 0.0F, weights[sample.lamp] > 0.0) << "lamp " << sample.lamp;
        ASSERT_EQ(sample.distance > 0.0F, sample.density > 0.0F) << "lamp " << sample.lamp;
    }
}

pt::Scene few_lamps() {
    pt::Scene scene;
    lamp_scenes::add_lamp(scene, {0.5, 3, -1}, 1, 2);
    lamp_scenes::add_lamp(scene, {4, -0.3, 2}, 0.8, 30); // center below the horizon
    lamp_scenes::add_lamp(scene, {-300, 500, 200}, 0.5, 1e6);
    lamp_scenes::add_lamp(scene, {-0.6, 0.55, 0.5}, 0.9, 0.01); // 0.05 away
    lamp_scenes::add_lamp(scene, {0, -5, 0}, 2, 1e8);           // below the horizon
    lamp_scenes::add_lamp(scene, {1, 0.2, -0.5}, 0.1, 1e-4);
    return scene;
}

// Nine tenths of the choices have the weights radiance * (r / d)^2 * min(1, (n . v + r) / d). One tenth is spread
// evenly over the lamps partly above the horizon.
TEST(LampChoice, HasTheDocumentedProbability) {
    const pt::View view = lamp_scenes::view_of(few_lamps());
    const TreeVertex vertex{{0, 0, 0}, {0, 1, 0}};
    const std::vector<double> weights = lamp_weights(view, vertex);
    const std::vector<double> probabilities = TreeProbe(view).probabilities(vertex);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    ASSERT_EQ(std::ranges::count(weights, 0.0), 1);
    for (std::size_t lamp = 0; lamp < weights.size(); ++lamp) {
        const double documented = weights[lamp] > 0.0 ? 0.9 * weights[lamp] / total + 0.1 / 5.0 : 0.0;
        EXPECT_NEAR(probabilities[lamp], documented, 2e-6 * documented) << lamp;
    }
}

// The bound for 99 chi-squares allows one false alarm in a million, at 5.6 standard deviations. Errors of 10% increase
// a chi-square by 2^16 * 0.1^2 = 655. This is 15 standard deviations for 1000 lamps.
TEST(LampChoice, FollowsTheStatedProbability) {
    const double bound = statistics::normal_quantile(1e-6 / 99);
    std::vector<LampScene> scenes = lamp_scenes::all();
    scenes.push_back({"few", few_lamps()});
    scenes.push_back({"many in a list", lamp_scenes::in_a_box(20, 4)});
    scenes.push_back({"one", lamp_scenes::in_a_box(1, 4)});
    for (const auto &[name, scene] : scenes) {
        const pt::View view = lamp_scenes::view_of(scene);
        TreeProbe probe(view);
        const std::uint32_t lamp_count = view.features[pt::gpu::ID_LAMP_COUNT];
        std::uint32_t seed = 100;
        for (const TreeVertex &vertex : tree_vertices(view)) {
            SCOPED_TRACE(name);
            const std::vector<TreeDrawn> drawn = probe.draw(vertex, 1U << 16, seed++);
            const std::vector<double> weights = lamp_weights(view, vertex);
            expect_what_is_stated(drawn, weights);
            const bool has_tree = view.features[pt::gpu::ID_LAMP_TREE_LEVELS] > 0;
            const bool is_any_seen = *std::ranges::max_element(weights) > 0.0;
            double sum = 0.0;
            for (std::uint32_t lamp = 0; lamp < lamp_count; ++lamp)
                sum += static_cast<double>(drawn[lamp].probability);
            EXPECT_NEAR(sum, has_tree || is_any_seen ? 1.0 : 0.0, 64 * 0x1p-24) << "a few roundings per level";
            const Frequencies cells = frequencies(drawn, lamp_count);
            if (cells.expected.size() < 2)
                continue;
            EXPECT_LT(statistics::chi_square_deviate(cells.observed, cells.expected), bound) << seed;
            EXPECT_GT(statistics::chi_square_deviate(cells.observed, cells.wrong), bound)
                << "probabilities wrong by 10% must show";
        }
    }
}

// Returns sum (w^2 / P) / (sum w)^2 - 1. The value is 0 if P is proportional to w, at most 1 / 9 if a tenth of the
// choices is uniform, and 9 for choices by power alone.
double relative_variance(TreeProbe &probe, const pt::View &scene, const TreeVertex &vertex) {
    const std::vector<double> weights = lamp_weights(scene, vertex);
    const std::vector<double> probabilities = probe.probabilities(vertex);
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t lamp = 0; lamp < weights.size(); ++lamp) {
        sum += weights[lamp];
        squares += weights[lamp] * weights[lamp] / probabilities[lamp];
    }
    return squares / (sum * sum) - 1.0;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

TEST(LampChoice, IsSharpInTrees) {
    for (const double motion : {0.0, 3.0}) {
        const pt::View scene = lamp_scenes::view_of(lamp_scenes::in_a_box(10000, 8, motion));
        TreeProbe probe(scene);
        std::vector<double> on_ground;
        std::vector<double> in_midair;
        for (int i = 0; i < 25; ++i) {
            const glm::vec3 place(3.5F * static_cast<float>(i % 5 - 2), 0, 3.5F * static_cast<float>(i / 5 - 2));
            const auto angle = static_cast<float>(i);
            const glm::vec3 normal = glm::normalize(glm::vec3(std::cos(angle), std::sin(2 * angle), std::sin(angle)));
            on_ground.push_back(relative_variance(probe, scene, {place, {0, 1, 0}, 0.5F}));
            in_midair.push_back(relative_variance(probe, scene, {place + glm::vec3(0, 4, 0), normal, 0.5F}));
        }
        EXPECT_LT(median(on_ground), 0.25) << motion;
        EXPECT_LT(statistics::moments(on_ground).mean, 0.4) << motion;
        EXPECT_LT(median(in_midair), 0.6) << motion;
        RecordProperty("relative_variance_" + std::to_string(motion > 0.0),
                       std::to_string(median(on_ground)) + " / " + std::to_string(statistics::moments(on_ground).mean) +
                           ", " + std::to_string(median(in_midair)));
    }
}

} // namespace
