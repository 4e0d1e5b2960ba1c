#include "lamps.spv.h"
#include "lib/view/scene_blocks.h"
#include "lib/view/view.h"
#include "shaders/specialization.h"
#include "tests/kernel/probe.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace {

void add_lamp(pt::Scene &scene, const glm::dvec3 &center, double radius, double radiance,
              const glm::dvec3 &motion = glm::dvec3(0.0)) {
    scene.materials.push_back({glm::vec3(0), glm::vec3(0), glm::vec3(static_cast<float>(radiance)), 0});
    scene.spheres.push_back({center, radius, motion, static_cast<std::uint32_t>(scene.materials.size() - 1)});
}

pt::Scene lamps_in_a_box(std::uint32_t count, double motion) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto between = [&](double low, double high) { return low + (high - low) * unit(generator); };
    pt::Scene scene;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 center(between(-10, 10), between(0.3, 8), between(-10, 10));
        const glm::dvec3 way(between(0.8 * motion, motion), between(0, 0.2 * motion), between(-motion, -0.8 * motion));
        add_lamp(scene, center, between(0.005, 0.02), std::pow(10.0, between(0, 8)), way);
    }
    return scene;
}

class LampProbe {
public:
    explicit LampProbe(const pt::Scene &scene) :
        view_(pt::view_of(pt::PreparedScene(scene), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0.25, 0.75},
                          {16, 12, 3, 0, 0, PT_ESTIMATOR_MIS, PT_SAMPLER_RANDOM, 0, 12})),
        lamp_count_(view_.features[pt::gpu::ID_LAMP_COUNT]),
        probe_(lamps_spirv(), sizeof(Push), pt::specialization_constants(view_.features)) {
        probe_.set_scene(view_.words);
    }

    std::vector<double> probabilities(const glm::vec3 &position, const glm::vec3 &normal, float time) {
        const Push push{glm::vec4(position, 0), glm::vec4(normal, time), lamp_count_};
        const std::vector<float> stated = probe_.run<float>({}, lamp_count_, push, lamp_count_);
        return {stated.begin(), stated.end()};
    }

    // Returns the documented weight of each lamp.
    std::vector<double> weights(const glm::vec3 &position, const glm::vec3 &normal, float time) const {
        std::vector<double> weights;
        const pt::SceneBlocks blocks(view_.features);
        for (std::uint32_t lamp = 0; lamp < lamp_count_; ++lamp) {
            glm::dvec3 to = glm::dvec3(glm::vec3(view_.words[lamp])) - glm::dvec3(position);
            if (view_.features[pt::gpu::ID_MOTION])
                to += double{time} * glm::dvec3(glm::vec3(view_.words[blocks.motion + lamp]));
            const double radius = double{view_.words[lamp].w};
            const double distance = glm::length(to);
            const double cosine = std::min(1.0, (glm::dot(to, glm::dvec3(normal)) + radius) / distance);
            const double radiance = double{view_.words[blocks.emission + lamp].w};
            weights.push_back(cosine > 0.0 ? radiance * std::pow(radius / distance, 2) * cosine : 0.0);
        }
        return weights;
    }

    // Returns sum (w^2 / P) / (sum w)^2 - 1. The value is 0 if P is proportional to w, at most 1 / 9 if a tenth of the
    // choices is uniform, and 9 for choices by power alone.
    double relative_variance(const glm::vec3 &position, const glm::vec3 &normal) {
        const std::vector<double> weighed = weights(position, normal, 0.5F);
        const std::vector<double> stated = probabilities(position, normal, 0.5F);
        EXPECT_NEAR(std::accumulate(stated.begin(), stated.end(), 0.0), 1.0, 64 * 0x1p-24) << "some roundings a level";
        double squares = 0.0;
        for (std::size_t lamp = 0; lamp < weighed.size(); ++lamp)
            squares += weighed[lamp] * weighed[lamp] / stated[lamp];
        return squares / std::pow(std::accumulate(weighed.begin(), weighed.end(), 0.0), 2) - 1.0;
    }

private:
    struct Push {
        glm::vec4 position, normal_time;
        std::uint32_t count;
    };

    pt::View view_;
    std::uint32_t lamp_count_;
    Probe probe_;
};

// Nine tenths of the choices are by weight. One tenth is spread evenly over the lamps partly above the horizon.
TEST(LampChoice, HasTheDocumentedProbability) {
    pt::Scene scene;
    add_lamp(scene, {0.5, 3, -1}, 1, 2);
    add_lamp(scene, {4, -0.3, 2}, 0.8, 30); // center below the horizon
    add_lamp(scene, {-300, 500, 200}, 0.5, 1e6);
    add_lamp(scene, {-0.6, 0.55, 0.5}, 0.9, 0.01); // 0.05 away
    add_lamp(scene, {0, -5, 0}, 2, 1e8);           // below the horizon
    add_lamp(scene, {1, 0.2, -0.5}, 0.1, 1e-4);
    LampProbe probe(scene);
    const std::vector<double> weights = probe.weights({0, 0, 0}, {0, 1, 0}, 0.0F);
    const std::vector<double> probabilities = probe.probabilities({0, 0, 0}, {0, 1, 0}, 0.0F);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    ASSERT_EQ(std::ranges::count(weights, 0.0), 1);
    for (std::size_t lamp = 0; lamp < weights.size(); ++lamp) {
        const double documented = weights[lamp] > 0.0 ? 0.9 * weights[lamp] / total + 0.1 / 5.0 : 0.0;
        EXPECT_NEAR(probabilities[lamp], documented, 2e-6 * documented) << lamp;
    }
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

// Nodes must move with their lamps.
TEST(LampChoice, IsSharpInTrees) {
    for (const double motion : {0.0, 15.0}) {
        LampProbe probe(lamps_in_a_box(10000, motion));
        std::vector<double> on_ground;
        std::vector<double> in_midair;
        for (int i = 0; i < 25; ++i) {
            const glm::vec3 place(3.5F * static_cast<float>(i % 5 - 2), 0, 3.5F * static_cast<float>(i / 5 - 2));
            const auto angle = static_cast<float>(i);
            const glm::vec3 normal = glm::normalize(glm::vec3(std::cos(angle), std::sin(2 * angle), std::sin(angle)));
            on_ground.push_back(probe.relative_variance(place, {0, 1, 0}));
            in_midair.push_back(probe.relative_variance(place + glm::vec3(0, 4, 0), normal));
        }
        EXPECT_LT(median(on_ground), 0.25) << motion;
        EXPECT_LT(statistics::moments(on_ground).mean, 0.4) << motion;
        EXPECT_LT(median(in_midair), 0.6) << motion;
    }
}

} // namespace
