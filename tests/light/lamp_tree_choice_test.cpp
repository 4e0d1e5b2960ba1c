#include "tests/light/lamp_tree_probe.h"
#include "tests/light/lamp_tree_reference.h"
#include "tests/support/lamp_scenes.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

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

// Over 72 chi-squares the bound allows one false alarm in a million, at 5.6 standard deviations. Errors of 10% add 2^16
// * 0.1^2 = 655 to a chi-square, which is 15 standard deviations for 1000 lamps.
TEST(LampTreeChoice, FollowsTheStatedProbability) {
    const double bound = statistics::normal_quantile(1e-6 / 72);
    for (const auto &[name, scene] : lamp_scenes::all()) {
        const pt::GpuScene gpu_scene = lamp_scenes::gpu_scene(scene);
        TreeProbe probe(gpu_scene);
        const std::uint32_t lamp_count = gpu_scene.features[pt::gpu::ID_LAMP_COUNT];
        std::uint32_t seed = 100;
        for (const TreeVertex &vertex : tree_vertices(gpu_scene)) {
            SCOPED_TRACE(name);
            const std::vector<TreeDrawn> drawn = probe.draw(vertex, 1U << 16, seed++);
            expect_what_is_stated(drawn, lamp_weights(gpu_scene, vertex));
            const Frequencies cells = frequencies(drawn, lamp_count);
            EXPECT_LT(statistics::chi_square_deviate(cells.observed, cells.expected), bound) << seed;
            EXPECT_GT(statistics::chi_square_deviate(cells.observed, cells.wrong), bound)
                << "probabilities wrong by 10% must show";
        }
    }
}

} // namespace
