// Compares stated probabilities of lamps in a tree with double precision, and with ideal probabilities.
#include "tests/light/lamp_tree_probe.h"
#include "tests/light/lamp_tree_reference.h"
#include "tests/support/lamp_scenes.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace {

// Rounded positions change a quotient by up to 2^-20, because the distance between any lamp and a vertex is at least a
// 1000th of the vertex's distance from the camera.
TEST(LampTreeProbabilities, AreThoseOfAReferenceInDouble) {
    for (const auto &[name, scene] : lamp_scenes::all()) {
        const pt::GpuScene gpu_scene = lamp_scenes::gpu_scene(scene);
        ASSERT_TRUE(gpu_scene.features[pt::gpu::ID_LAMP_TREE_LEVELS]) << name;
        TreeProbe probe(gpu_scene);
        const TreeReference reference(gpu_scene);
        for (const TreeVertex &vertex : tree_vertices(gpu_scene)) {
            const std::vector<double> expected = reference.probabilities(vertex);
            const std::vector<double> stated = probe.probabilities(vertex);
            double sum = 0.0;
            double stated_sum = 0.0;
            for (std::size_t lamp = 0; lamp < expected.size(); ++lamp) {
                EXPECT_NEAR(stated[lamp], expected[lamp], 2e-4 * expected[lamp]) << name << ", lamp " << lamp;
                sum += expected[lamp];
                stated_sum += stated[lamp];
            }
            EXPECT_NEAR(sum, 1.0, 1e-12) << name;
            EXPECT_NEAR(stated_sum, 1.0, 64 * 0x1p-24) << name;
        }
    }
}

// sum (w^2 / P) / (sum w)^2 - 1, where w is the light of a lamp and P its probability. The result is 0 for
// probabilities in proportion to the light, at most 1 / 9 with the evenly chosen tenth, and 9 by power alone.
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

} // namespace
