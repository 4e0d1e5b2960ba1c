#include "lamps.spv.h"
#include "shaders/specialization.h"
#include "tests/kernel/probe.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace {

struct Lamp {
    glm::vec3 center;
    float radius;
    float radiance;
};

struct Drawn {
    glm::vec3 direction;
    float distance;
    std::uint32_t lamp;
    float density;     // per solid angle, given the lamp
    float hit_density; // if lamps are found by chance
    float probability;
};

struct Viewpoint {
    glm::vec3 position{0};
    glm::vec3 normal{0, 1, 0};
    std::uint32_t surface = 0xffffffffU;
};

std::vector<Drawn> draw(const std::vector<Lamp> &lamps, const Viewpoint &from, std::uint32_t seed,
                        std::uint32_t count) {
    struct {
        glm::vec4 position, normal;
        std::uint32_t surface, seed, count;
    } push{glm::vec4(from.position, 0), glm::vec4(from.normal, 0), from.surface, seed, count};
    const auto lamp_count = static_cast<std::uint32_t>(lamps.size());
    std::array<std::uint32_t, pt::gpu::CONSTANT_COUNT> constants{};
    constants[pt::gpu::ID_SPHERE_COUNT] = lamp_count;
    constants[pt::gpu::ID_LAMP_COUNT] = lamp_count;
    constants[pt::gpu::ID_SCENE_SOURCE] = pt::gpu::SCENE_IN_UNIFORM;
    constants[pt::gpu::ID_POINT_BLOCKS] = probe_point_blocks;
    constants[pt::gpu::ID_SAMPLER] = PT_SAMPLER_RANDOM;
    std::vector<glm::vec4> scene(2 * lamps.size());
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        scene[i] = glm::vec4(lamps[i].center, lamps[i].radius);
        scene[lamps.size() + i] = glm::vec4(lamps[i].radiance);
    }
    Probe probe(lamps_spirv(), sizeof push, constants);
    probe.set_scene(scene);
    return probe.run<Drawn>({}, count, push, count);
}

const std::vector<Lamp> uneven_lamps = {
    {{0.5F, 3.0F, -1.0F}, 1.0F, 2.0F},       {{4.0F, -0.3F, 2.0F}, 0.8F, 30.0F},  // center below the horizon
    {{-300.0F, 500.0F, 200.0F}, 0.5F, 1e6F}, {{-0.6F, 0.55F, 0.5F}, 0.9F, 0.01F}, // the second lamp is 0.05 away
    {{0.0F, -5.0F, 0.0F}, 2.0F, 1e8F},                                            // wholly below the horizon
    {{-3.0F, 1.0F, 4.0F}, 0.02F, 5000.0F},   {{1.0F, 0.2F, -0.5F}, 0.1F, 1e-4F},
};
constexpr std::size_t below_horizon = 4;
// Probabilities that are wrong by 3% increase a chi-square by 2^19 * 0.03^2 = 472. The standard deviation of the
// chi-square is below 4.
constexpr std::uint32_t draws_of_lamps = 1U << 19;

const double lamp_bound = statistics::normal_quantile(1e-6 / 2);

void expect_stated_probabilities(const std::vector<Lamp> &lamps) {
    const std::vector<Drawn> drawn = draw(lamps, {}, 7, draws_of_lamps);
    std::vector<double> counts(lamps.size());
    for (std::size_t i = lamps.size(); i < drawn.size(); ++i)
        ++counts[drawn[i].lamp];
    const double total = static_cast<double>(draws_of_lamps - lamps.size());
    std::vector<double> observed, expected, wrong;
    for (std::size_t i = 0; i < lamps.size(); ++i)
        if (i == below_horizon) {
            EXPECT_EQ(counts[i], 0.0);
        } else {
            observed.push_back(counts[i]);
            expected.push_back(total * static_cast<double>(drawn[i].probability));
            wrong.push_back(expected.back() * (i < 3 ? 1.03 : 0.97));
        }
    EXPECT_LT(statistics::chi_square_deviate(observed, expected), lamp_bound);
    EXPECT_GT(statistics::chi_square_deviate(observed, wrong), lamp_bound) << "probabilities wrong by 3% must show";
}

// The second scene has so few lamps that the kernel keeps a LampView of each (KEEP_VIEWS).
TEST(LampChoice, FollowsTheStatedProbability) {
    expect_stated_probabilities(uneven_lamps);
    std::vector<Lamp> few(uneven_lamps.begin(), uneven_lamps.begin() + 4);
    few[0].radiance = 5000.0F;
    expect_stated_probabilities(few);
}

// Nine tenths of the choices have the weights radiance * (r / d)^2 * min(1, (n . v + r) / d). One tenth is spread
// evenly over the lamps partly above the horizon.
TEST(LampChoice, HasTheDocumentedProbability) {
    const std::vector<Drawn> drawn = draw(uneven_lamps, {}, 9, 64);
    std::vector<double> weights;
    double total = 0.0;
    for (const Lamp &lamp : uneven_lamps) {
        const double distance = glm::length(glm::dvec3(lamp.center));
        const double cosine = std::min(1.0, (double{lamp.center.y} + double{lamp.radius}) / distance);
        weights.push_back(lamp.radiance * std::pow(lamp.radius / distance, 2) * std::max(cosine, 0.0));
        total += weights.back();
    }
    for (std::size_t i = 0; i < uneven_lamps.size(); ++i) {
        const double documented = i == below_horizon ? 0.0 : 0.9 * weights[i] / total + 0.1 / 6.0;
        EXPECT_NEAR(drawn[i].probability, documented, 2e-6 * documented) << "lamp " << i;
    }
}

TEST(LampChoice, IsPossibleExactlyForLampsAboveTheHorizon) {
    std::vector<Lamp> lamps;
    std::vector<bool> above;
    for (const float top : {1.0F, 1e-1F, 1e-3F, 1e-5F, 0.0F, -1e-5F, -1e-3F, -1.0F}) {
        lamps.push_back({{3.0F, top - 1.0F, 1.0F}, 1.0F, 1.0F});
        above.push_back(lamps.back().center.y + 1.0F > 0.0F);
    }
    const std::vector<Drawn> drawn = draw(lamps, {}, 10, 64);
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        EXPECT_EQ(drawn[i].probability > 0.0F, above[i]) << "lamp " << i;
        EXPECT_EQ(drawn[i].density > 0.0F, above[i]) << "lamp " << i;
    }
}

TEST(LampChoice, LeavesOutLampsThatContainTheVertexOrAreIt) {
    const std::vector<Lamp> lamps = {
        {{0.1F, 0.2F, 0.0F}, 1.0F, 5.0F},
        {{0.0F, -2.0F, 0.0F}, 2.0F, 5.0F},
        {{0.0F, 1000.0F, 0.0F}, 0.1F, 1e-6F} // the only lamp above the horizon
    };
    Viewpoint on_second;
    on_second.surface = 1;
    for (const Drawn &sample : draw(lamps, on_second, 11, 4096)) {
        EXPECT_EQ(sample.density > 0.0F, sample.lamp == 2);
        EXPECT_EQ(sample.distance > 0.0F, sample.lamp == 2);
        EXPECT_EQ(sample.probability, sample.lamp == 2 ? 1.0F : 0.0F) << "lamp " << sample.lamp;
    }
}

TEST(LampChoice, StatesZeroWhereNoLampCanBeSampled) {
    const std::vector<Lamp> lamps = {{{0.0F, -3.0F, 0.0F}, 1.0F, 5.0F}, {{0.0F, 0.0F, 0.0F}, 9.0F, 5.0F}};
    for (const Drawn &sample : draw(lamps, {}, 12, 256)) {
        EXPECT_EQ(sample.density, 0.0F);
        EXPECT_EQ(sample.probability, 0.0F);
        EXPECT_EQ(sample.distance, 0.0F);
    }
}

} // namespace
