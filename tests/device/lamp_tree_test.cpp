// Lamps as the device chooses them by the tree: what it states as their probabilities against a reference in double,
// and its choices against what it states. Run alone with --gtest_filter=LampTree*.
#include "lamps.spv.h"
#include "lib/kernel/lamp_tree_words.h"
#include "lib/kernel/scene_blocks.h"
#include "shaders/gpu_layout.h"
#include "tests/device/kernel_render.h"
#include "tests/device/probe.h"
#include "tests/support/lamp_scenes.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace {

namespace gpu = pt::gpu;

constexpr double uniform_share = 0.1;

struct TreeVertex {
    glm::vec3 position;
    glm::vec3 normal;
    float time = 0.0F;
    std::uint32_t surface = 0xffffffffU;
};

// What lamps.comp writes.
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
    explicit TreeProbe(const pt::GpuScene &scene) :
        lamp_count_(scene.features.lamp_count),
        probe_(lamps_spirv, sizeof(Push), constants(scene)) {
        probe_.set_scene(scene.words);
    }

    // count draws after what choice_of() says of each lamp.
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

    static std::array<std::uint32_t, gpu::CONSTANT_COUNT> constants(const pt::GpuScene &scene) {
        auto constants = pt::specialization_constants(scene.features);
        constants[gpu::ID_POINT_BLOCKS] = probe_point_blocks;
        return constants;
    }

    std::uint32_t lamp_count_;
    Probe probe_;
};

// Vertices on the ground, in the air, with all lamps ahead and all behind, far away, and by a lamp.
std::vector<TreeVertex> tree_vertices(const pt::GpuScene &scene) {
    const glm::vec3 lamp(scene.words[scene.features.lamp_count / 2]);
    const float radius = scene.words[scene.features.lamp_count / 2].w;
    const glm::vec3 oblique = glm::normalize(glm::vec3(2, -1, 0.5F));
    return {{{0, 0, 0}, {0, 1, 0}, 0.0F},
            {{7, 0, -3}, {0, 1, 0}, 0.375F},
            {{-4, 3, 2}, oblique, 1.0F},
            {{1, 5, -6}, {0, -1, 0}, 0.5F},
            {{0, -50, 0}, {0, 1, 0}, 0.25F},
            {{0, -50, 0}, {0, -1, 0}, 0.25F},
            {{400, 300, 5}, -glm::normalize(glm::vec3(4, 3, 0)), 0.75F},
            {lamp + 1.5F * radius * glm::vec3(0, 0, 1), {0, 0.6F, -0.8F}, 0.0F},
            {lamp, {0, 0, 1}, 0.0F, scene.features.lamp_count / 2}};
}

// The probabilities in double, from what gpu_layout.h says of the tree's words and shaders/README.md of its choices.
class TreeReference {
public:
    explicit TreeReference(const pt::GpuScene &scene) : features_(scene.features), words_(scene.words) {
        words_.erase(words_.begin(),
                     words_.begin() + static_cast<std::ptrdiff_t>(pt::SceneBlocks(features_).lamp_tree));
        while (features_.lamp_count > 16U << (2 * levels_))
            ++levels_;
        top_ = (features_.lamp_count + (4U << (2 * levels_)) - 1) / (4U << (2 * levels_));
    }

    std::vector<double> probabilities(const TreeVertex &vertex) const {
        std::vector<double> shares(features_.lamp_count);
        std::vector<std::array<double, 4>> groups;
        double total = 0.0;
        for (std::uint32_t group = 0; group < top_; ++group) {
            groups.push_back(importance(group, vertex));
            total += sum(groups.back());
        }
        for (std::uint32_t group = 0; group < top_; ++group) {
            const double part = total > 0.0 ? sum(groups[group]) / total : 1.0 / top_;
            descend(group, groups[group], part, 0, top_, vertex, shares);
        }
        for (double &share : shares)
            share = (1.0 - uniform_share) * share + uniform_share / features_.lamp_count;
        return shares;
    }

private:
    static double sum(const std::array<double, 4> &of) { return of[0] + of[1] + of[2] + of[3]; }

    double number(std::uint64_t group, std::size_t word, int node) const {
        return words_[gpu::lamp_tree_group_words(features_.motion ? 1 : 0) * group + word][node];
    }

    bool is_leaf(std::uint64_t group) const { return group >= top_ * ((1U << (2 * levels_)) - 1) / 3; }

    std::uint32_t lamp_of(std::uint64_t group, int node) const {
        const std::uint32_t above = top_ * ((1U << (2 * levels_)) - 1) / 3;
        const std::uint32_t groups = top_ * ((4U << (2 * levels_)) - 1) / 3;
        return std::bit_cast<std::uint32_t>(
                   words_[gpu::lamp_tree_group_words(features_.motion ? 1 : 0) * groups + group - above][node]) -
               gpu::MATERIAL_INDEX_BITS;
    }

    std::array<double, 4> importance(std::uint64_t group, const TreeVertex &vertex) const {
        std::array<double, 4> result{};
        for (int node = 0; node < 4; ++node) {
            glm::dvec3 way(0.0);
            if (features_.motion)
                way = {number(group, 5, node), number(group, 6, node), number(group, 7, node)};
            const glm::dvec3 place(number(group, 0, node), number(group, 1, node), number(group, 2, node));
            const glm::dvec3 to = place + double{vertex.time} * way - glm::dvec3(vertex.position);
            const double height = glm::dot(to, glm::dvec3(vertex.normal));
            const double power = number(group, 3, node);
            const double spread = number(group, 4, node);
            double &value = result[static_cast<std::size_t>(node)];
            if (is_leaf(group)) {
                const double squared = glm::dot(to, to);
                if (power > 0.0 && height + spread > 0.0 && squared > spread * spread)
                    value = power / squared * std::min(1.0, (height + spread) / std::sqrt(squared));
            } else {
                const double squared = glm::dot(to, to) + spread / 2;
                const double variance = spread / 3;
                const double root = std::sqrt(height * height + variance);
                const double mean = height < 0.0 ? variance / (root - height) / 2 : (height + root) / 2;
                value = power / squared * std::min(1.0, mean / std::sqrt(squared));
            }
        }
        return result;
    }

    void descend(std::uint64_t group, std::array<double, 4> parts, double probability, std::uint64_t level_first,
                 std::uint64_t level_count, const TreeVertex &vertex, std::vector<double> &shares) const {
        for (int node = 0; node < 4; ++node)
            if (sum(importance(group, vertex)) == 0.0)
                parts[static_cast<std::size_t>(node)] = number(group, 3, node) > 0.0 ? 1.0 : 0.0;
        for (int node = 0; node < 4; ++node) {
            const double part = probability * parts[static_cast<std::size_t>(node)] / sum(parts);
            if (part == 0.0)
                continue;
            if (is_leaf(group)) {
                shares[lamp_of(group, node)] += part;
                continue;
            }
            const std::uint64_t next_first = level_first + level_count;
            const std::uint64_t child = next_first + 4 * (group - level_first) + static_cast<std::uint64_t>(node);
            descend(child, importance(child, vertex), part, next_first, 4 * level_count, vertex, shares);
        }
    }

    pt::Features features_;
    std::vector<glm::vec4> words_; // of the tree
    std::uint32_t levels_ = 1;
    std::uint32_t top_ = 0;
};

// Weights as shaders/README.md defines them, from the lamps themselves.
std::vector<double> lamp_weights(const pt::GpuScene &scene, const TreeVertex &vertex) {
    std::vector<double> weights;
    const pt::SceneBlocks blocks(scene.features);
    for (std::uint32_t lamp = 0; lamp < scene.features.lamp_count; ++lamp) {
        glm::dvec3 to = glm::dvec3(glm::vec3(scene.words[lamp])) - glm::dvec3(vertex.position);
        if (scene.features.motion)
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

TEST(LampTreeProbabilities, SumToOneAndAreNeverBelowTheUniformShare) {
    for (const auto &[name, scene] : lamp_scenes::all()) {
        const pt::GpuScene gpu_scene = lamp_scenes::gpu_scene(scene);
        ASSERT_TRUE(gpu_scene.features.lamp_tree) << name;
        TreeProbe probe(gpu_scene);
        const auto count = static_cast<double>(gpu_scene.features.lamp_count);
        for (const TreeVertex &vertex : tree_vertices(gpu_scene)) {
            const std::vector<double> probabilities = probe.probabilities(vertex);
            double sum = 0.0;
            for (const double probability : probabilities) {
                EXPECT_GE(probability, uniform_share / count * (1.0 - 0x1p-22)) << name;
                sum += probability;
            }
            // Each level's quotients are rounded a few times.
            EXPECT_NEAR(sum, 1.0, 64 * 0x1p-24) << name;
        }
    }
}

// A quotient of importances is off by the rounding of differences of places: 2^-20 of a share at most in these scenes,
// where nothing is nearer to a vertex than a 1000th of what it is off the camera.
TEST(LampTreeProbabilities, AreThoseOfAReferenceInDouble) {
    for (const auto &[name, scene] : lamp_scenes::all()) {
        const pt::GpuScene gpu_scene = lamp_scenes::gpu_scene(scene);
        TreeProbe probe(gpu_scene);
        const TreeReference reference(gpu_scene);
        for (const TreeVertex &vertex : tree_vertices(gpu_scene)) {
            const std::vector<double> expected = reference.probabilities(vertex);
            const std::vector<double> stated = probe.probabilities(vertex);
            double sum = 0.0;
            for (std::size_t lamp = 0; lamp < expected.size(); ++lamp) {
                EXPECT_NEAR(stated[lamp], expected[lamp], 2e-4 * expected[lamp]) << name << ", lamp " << lamp;
                sum += expected[lamp];
            }
            EXPECT_NEAR(sum, 1.0, 1e-12) << name;
        }
    }
}

TEST(LampTreeChoice, ReportsTheProbabilityThatIsStatedForTheLampBitByBit) {
    for (const auto &[name, scene] : lamp_scenes::all()) {
        const pt::GpuScene gpu_scene = lamp_scenes::gpu_scene(scene);
        TreeProbe probe(gpu_scene);
        const std::uint32_t lamp_count = gpu_scene.features.lamp_count;
        for (const TreeVertex &vertex : tree_vertices(gpu_scene)) {
            const std::vector<TreeDrawn> drawn = probe.draw(vertex, 1U << 14);
            for (std::size_t i = lamp_count; i < drawn.size(); ++i) {
                ASSERT_LT(drawn[i].lamp, lamp_count) << name;
                ASSERT_EQ(std::bit_cast<std::uint32_t>(drawn[i].probability),
                          std::bit_cast<std::uint32_t>(drawn[drawn[i].lamp].probability))
                    << name << ", lamp " << drawn[i].lamp;
            }
        }
    }
}

// Lamps that are expected less than 20 times share a cell, which also tells whether rare ones are as rare as they say.
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

// One false alarm in a million, over the 72 chi-squares of this file together.
TEST(LampTreeChoice, FollowsTheStatedProbability) {
    const double bound = statistics::normal_quantile(1e-6 / 72);
    for (const auto &[name, scene] : lamp_scenes::all()) {
        const pt::GpuScene gpu_scene = lamp_scenes::gpu_scene(scene);
        TreeProbe probe(gpu_scene);
        const std::uint32_t lamp_count = gpu_scene.features.lamp_count;
        std::uint32_t seed = 100;
        for (const TreeVertex &vertex : tree_vertices(gpu_scene)) {
            const Frequencies cells = frequencies(probe.draw(vertex, 1U << 18, seed++), lamp_count);
            EXPECT_LT(statistics::chi_square_deviate(cells.observed, cells.expected), bound) << name << ' ' << seed;
            EXPECT_GT(statistics::chi_square_deviate(cells.observed, cells.wrong), bound)
                << "probabilities wrong by 10% must show";
        }
    }
}

// What it says of a lamp that cannot be sampled is no light, also where that is so of all.
TEST(LampTreeChoice, TakesLampsThatCannotBeSampledForNone) {
    for (const auto &[name, scene] : lamp_scenes::all()) {
        const pt::GpuScene gpu_scene = lamp_scenes::gpu_scene(scene);
        TreeProbe probe(gpu_scene);
        for (const TreeVertex &vertex : tree_vertices(gpu_scene)) {
            const std::vector<double> weights = lamp_weights(gpu_scene, vertex);
            for (const TreeDrawn &sample : probe.draw(vertex, 256)) {
                EXPECT_TRUE(std::isfinite(sample.density) && std::isfinite(sample.probability)) << name;
                EXPECT_EQ(sample.density > 0.0F, weights.at(sample.lamp) > 0.0) << name << ", lamp " << sample.lamp;
                EXPECT_EQ(sample.distance > 0.0F, sample.density > 0.0F) << name;
            }
        }
    }
}

// Of a sample of the lamps' irradiance: sum w^2 / P over (sum w)^2, less 1. The weights alone have 0, with the uniform
// share 1 / 9 at most; choice by power has 9 on the ground here.
double relative_variance(TreeProbe &probe, const pt::GpuScene &scene, const TreeVertex &vertex) {
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

// On the ground, and in the midst of the lamps with the horizon in all directions.
TEST(LampTreeProbabilities, AreSharp) {
    for (const double motion : {0.0, 3.0}) {
        const pt::GpuScene scene = lamp_scenes::gpu_scene(lamp_scenes::in_a_box(10000, 8, motion));
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

// The same scene for a kernel that has no tree.
pt::GpuScene without_lamp_tree(pt::GpuScene scene) {
    const pt::SceneBlocks blocks(scene.features);
    const auto first = scene.words.begin() + static_cast<std::ptrdiff_t>(blocks.lamp_tree);
    scene.words.erase(first, first + static_cast<std::ptrdiff_t>(blocks.index - blocks.lamp_tree));
    scene.features.lamp_tree = false;
    return scene;
}

std::vector<float> image_of(const pt::GpuScene &scene) {
    const KernelRender render(scene);
    const std::uint32_t source = scene.features.scene_in_uniform ? gpu::SCENE_IN_UNIFORM : gpu::SCENE_IN_STORAGE;
    return render.radiance(render.film(source, render.words()));
}

// How many standard errors the mean of one image is off another's, whose pixels are independent.
double deviation(const std::vector<float> &image, const std::vector<float> &other, double factor) {
    std::vector<double> differences;
    for (std::size_t i = 0; i < image.size(); i += 3)
        differences.push_back(factor * static_cast<double>(image[i]) - static_cast<double>(other[i]));
    const statistics::Moments moments = statistics::moments(differences);
    return std::abs(moments.mean) / std::sqrt(moments.variance / static_cast<double>(differences.size()));
}

struct LitScene {
    std::uint32_t lamp_count;
    double motion;
    std::uint32_t path_length;
};

// A floor and balls under lamps that the camera does not see; the last scene is in the storage buffer. Five standard
// errors at most: a false alarm in 10^6 runs.
TEST(LampTreeImage, HasTheMeanOfOneWithoutTheTree) {
    for (const auto &[count, motion, path_length] :
         {LitScene{40, 0.0, 4}, LitScene{70, 2.0, 3}, LitScene{500, 0.0, 2}}) {
        pt::Scene scene = lamp_scenes::in_a_box(count, 4, motion);
        for (pt::Sphere &lamp : scene.spheres)
            lamp.center += glm::dvec3(0, 5, 0);
        scene.materials.push_back({glm::vec3(0.7F), glm::vec3(0), glm::vec3(0), 0});
        const auto grey = static_cast<std::uint32_t>(scene.materials.size() - 1);
        for (int i = 0; i < 3; ++i)
            scene.spheres.push_back({{2.0 * i - 2, -1.5, -6}, 0.5, glm::dvec3(0), grey});
        scene.planes.push_back({{0, 1, 0}, 2, grey});
        const pt::GpuScene with =
            pt::gpu_scene(pt::PreparedScene(scene), lamp_scenes::camera(), KernelRender::settings(path_length));
        ASSERT_TRUE(with.features.lamp_tree);
        const std::vector<float> image = image_of(with);
        const std::vector<float> other = image_of(without_lamp_tree(with));
        EXPECT_NE(image, other);
        EXPECT_LT(deviation(image, other, 1.0), 5.0) << count;
        EXPECT_GT(deviation(image, other, 1.1), 5.0) << "a tenth more light must show";
    }
}

} // namespace
