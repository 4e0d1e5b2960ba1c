// Lamps as the device chooses and samples them from a vertex: directions and choices against what the shipped functions
// state, and what they state against geometry in double. Run alone with --gtest_filter=Lamp*.
#include "lamps.spv.h"
#include "shaders/gpu_layout.h"
#include "tests/device/probe.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace {

struct Lamp {
    glm::vec3 centre;
    float radius;
    float radiance;
};

// What the probe writes for each sample, and first for each lamp.
struct Drawn {
    glm::vec3 direction;
    float distance;
    std::uint32_t lamp;
    float density;     // over solid angle, given the lamp: as the sample states it
    float hit_density; // as it is stated for a direction that happens to hit the lamp
    float probability;
};

struct Viewpoint {
    glm::vec3 position{0};
    glm::vec3 normal{0, 1, 0};
    std::uint32_t surface = 0xffffffffU; // of the vertex
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
        scene[i] = glm::vec4(lamps[i].centre, lamps[i].radius);
        scene[lamps.size() + i] = glm::vec4(lamps[i].radiance);
    }
    Probe probe(lamps_spirv(), sizeof push, constants);
    probe.set_scene(scene);
    return probe.run<Drawn>({}, count, push, count);
}

// 1 - cos of half the angle that a lamp subtends, in double.
double one_minus_cos(const Lamp &lamp, const Viewpoint &from) {
    const double distance = glm::length(glm::dvec3(lamp.centre) - glm::dvec3(from.position));
    const double squared_sine = std::pow(lamp.radius / distance, 2);
    return squared_sine / (1.0 + std::sqrt(1.0 - squared_sine));
}

// The lamps of most tests: emission over ten decades.
const std::vector<Lamp> uneven_lamps = {
    {{0.5F, 3.0F, -1.0F}, 1.0F, 2.0F},       // overhead
    {{4.0F, -0.3F, 2.0F}, 0.8F, 30.0F},      // its centre below the horizon
    {{-300.0F, 500.0F, 200.0F}, 0.5F, 1e6F}, // far and tiny, r / d = 8e-4
    {{-0.6F, 0.55F, 0.5F}, 0.9F, 0.01F},     // near: its surface 0.05 away
    {{0.0F, -5.0F, 0.0F}, 2.0F, 1e8F},       // wholly below the horizon
    {{-3.0F, 1.0F, 4.0F}, 0.02F, 5000.0F},   // small
    {{1.0F, 0.2F, -0.5F}, 0.1F, 1e-4F},      // dim
};
constexpr std::size_t below_horizon = 4;
// A density or probability that errs by 3% adds 2^19 * 0.03^2 = 472 to a chi-square, whose standard deviation is 23 for
// the 254 degrees of freedom of directions: 21 deviations, where 5.3 are allowed.
constexpr std::uint32_t draws_of_lamps = 1U << 19;

// One false alarm in a million, over the at most 20 chi-squares of this file together.
const double lamp_bound = statistics::normal_quantile(1e-6 / 20);

// Chi-square deviate of the directions towards one lamp against the density that they state, times density_error,
// over cells of equal solid angle.
double direction_deviate(const std::vector<Drawn> &drawn, const Lamp &lamp, const Viewpoint &from,
                         double density_error) {
    constexpr int bands = 15;
    constexpr int sectors = 17;
    const double height = one_minus_cos(lamp, from);
    const glm::dvec3 axis = glm::normalize(glm::dvec3(lamp.centre) - glm::dvec3(from.position));
    const glm::dvec3 helper = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 tangent = glm::normalize(glm::cross(axis, helper));
    const glm::dvec3 bitangent = glm::cross(axis, tangent);
    std::vector<double> observed(bands * sectors);
    for (const Drawn &sample : drawn) {
        const glm::dvec3 direction = glm::normalize(glm::dvec3(sample.direction));
        const glm::dvec3 chord = direction - axis;
        const double share = 0.5 * glm::dot(chord, chord) / height; // 1 - cos from the chord: no cancellation
        // The axis errs by a few 2^-24, less than 3e-4 of the narrowest cone here, 8e-4.
        EXPECT_LT(share, 1.001);
        const int band = std::min(static_cast<int>(share * bands), bands - 1);
        const double azimuth = std::atan2(glm::dot(direction, bitangent), glm::dot(direction, tangent));
        const int sector =
            std::min(static_cast<int>((azimuth / (2.0 * std::numbers::pi) + 0.5) * sectors), sectors - 1);
        ++observed[static_cast<std::size_t>(band * sectors + sector)];
    }
    const double solid_angle = 2.0 * std::numbers::pi * height / (bands * sectors);
    const double expected = static_cast<double>(drawn.size()) * double{drawn[0].density} * density_error * solid_angle;
    return statistics::chi_square_deviate(observed, std::vector<double>(observed.size(), expected));
}

TEST(LampDirections, FollowTheStatedDensity) {
    for (std::size_t i = 0; i < uneven_lamps.size(); ++i) {
        if (i == below_horizon)
            continue;
        const std::vector<Lamp> alone = {uneven_lamps[i]};
        const std::vector<Drawn> drawn = draw(alone, {}, 3, draws_of_lamps);
        EXPECT_LT(direction_deviate(drawn, alone[0], {}, 1.0), lamp_bound) << "lamp " << i;
        EXPECT_GT(direction_deviate(drawn, alone[0], {}, 1.03), lamp_bound) << "a density wrong by 3% must show";
        EXPECT_GT(direction_deviate(drawn, alone[0], {}, 0.97), lamp_bound) << "a density wrong by 3% must show";
    }
}

// Also among many lamps: whichever is chosen, the numbers that place the direction are independent of the choice.
TEST(LampDirections, DoNotDependOnTheChoice) {
    std::vector<Drawn> nearest;
    for (const Drawn &sample : draw(uneven_lamps, {}, 4, draws_of_lamps))
        if (sample.lamp == 0)
            nearest.push_back(sample);
    EXPECT_LT(direction_deviate(nearest, uneven_lamps[0], {}, 1.0), lamp_bound);
}

// The one density is stated twice, for a sample and for a direction that hits the lamp, by the same function: as far
// as they differ the weights of multiple importance sampling do not sum to 1. It is 1 / solid angle; float32 leaves a
// few 2^-24, and more where the lamp is near: 1 - (r / d)^2 cancels, by a factor 1 / (1 - (r / d)^2) below 20 here. A
// compiler may round each of the two in its own way, fusing products and sums.
TEST(LampDensity, IsTheSameForBothTechniquesAndRight) {
    const std::vector<Drawn> drawn = draw(uneven_lamps, {}, 6, 1U << 16);
    for (const Drawn &sample : drawn)
        ASSERT_NEAR(sample.density, sample.hit_density, 1e-5F * sample.density);
    for (std::size_t i = 0; i < uneven_lamps.size(); ++i) {
        const double density = 1.0 / (2.0 * std::numbers::pi * one_minus_cos(uneven_lamps[i], {}));
        if (i == below_horizon)
            EXPECT_EQ(drawn[i].density, 0.0F);
        else
            EXPECT_NEAR(drawn[i].density / density, 1.0, 1e-5) << "lamp " << i;
    }
}

double probability_sum(const std::vector<Drawn> &drawn, std::size_t lamp_count) {
    double sum = 0.0;
    for (std::size_t i = 0; i < lamp_count; ++i)
        sum += static_cast<double>(drawn[i].probability);
    return sum;
}

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

// Of many lamps, and of so few that the kernel keeps how it sees them.
TEST(LampChoice, FollowsTheStatedProbability) {
    expect_stated_probabilities(uneven_lamps);
    std::vector<Lamp> few(uneven_lamps.begin(), uneven_lamps.begin() + 4);
    few[0].radiance = 5000.0F; // else the far lamp has all but a thousandth
    expect_stated_probabilities(few);
}

// Each probability is rounded a few times, division within 2.5 ulp: 8 * 2^-24 of it at most.
TEST(LampChoice, ProbabilitiesSumToOne) {
    std::vector<Lamp> lamps = uneven_lamps;
    for (int i = 0; i < 33; ++i) {
        const auto t = static_cast<float>(i);
        lamps.push_back({{10.0F * std::sin(t), 6.0F + 0.01F * t, 10.0F * std::cos(2 * t)},
                         0.1F,
                         std::pow(10.0F, std::fmod(t, 12.0F) - 4.0F)});
    }
    const std::vector<Drawn> drawn = draw(lamps, {}, 8, 1024);
    EXPECT_NEAR(probability_sum(drawn, lamps.size()), 1.0, (8 + 40) * 0x1p-24);
    EXPECT_NEAR(probability_sum(draw(uneven_lamps, {}, 8, 64), uneven_lamps.size()), 1.0, 16 * 0x1p-24);
}

// As it is documented: nine tenths by radiance (r / d)^2 min(1, (n . v + r) / d), one tenth evenly. And so never
// below a tenth of the even share for a lamp that is partly above the horizon, however dim; 0 for one below it.
TEST(LampChoice, HasTheDocumentedProbability) {
    const std::vector<Drawn> drawn = draw(uneven_lamps, {}, 9, 64);
    std::vector<double> weights;
    double total = 0.0;
    for (const Lamp &lamp : uneven_lamps) {
        const double distance = glm::length(glm::dvec3(lamp.centre));
        const double cosine = std::min(1.0, (double{lamp.centre.y} + double{lamp.radius}) / distance);
        weights.push_back(lamp.radiance * std::pow(lamp.radius / distance, 2) * std::max(cosine, 0.0));
        total += weights.back();
    }
    for (std::size_t i = 0; i < uneven_lamps.size(); ++i) {
        const double documented = i == below_horizon ? 0.0 : 0.9 * weights[i] / total + 0.1 / 6.0;
        EXPECT_NEAR(drawn[i].probability, documented, 2e-6 * documented) << "lamp " << i;
    }
}

// A lamp that the vertex sees barely: its top above the horizon by a 1000th of its radius down to nothing.
TEST(LampChoice, IsPossibleExactlyForLampsAboveTheHorizon) {
    std::vector<Lamp> lamps;
    std::vector<bool> above;
    for (const float top : {1.0F, 1e-1F, 1e-3F, 1e-5F, 0.0F, -1e-5F, -1e-3F, -1.0F}) {
        lamps.push_back({{3.0F, top - 1.0F, 1.0F}, 1.0F, 1.0F});
        above.push_back(lamps.back().centre.y + 1.0F > 0.0F);
    }
    const std::vector<Drawn> drawn = draw(lamps, {}, 10, 64);
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        EXPECT_EQ(drawn[i].probability > 0.0F, above[i]) << "lamp " << i;
        EXPECT_EQ(drawn[i].density > 0.0F, above[i]) << "lamp " << i;
    }
}

TEST(LampChoice, LeavesOutLampsThatContainTheVertexOrAreIt) {
    const std::vector<Lamp> lamps = {
        {{0.1F, 0.2F, 0.0F}, 1.0F, 5.0F},    // around the vertex
        {{0.0F, -2.0F, 0.0F}, 2.0F, 5.0F},   // the vertex lies on it
        {{0.0F, 1000.0F, 0.0F}, 0.1F, 1e-6F} // the only one left, and dim
    };
    Viewpoint on_second;
    on_second.surface = 1;
    for (const Drawn &sample : draw(lamps, on_second, 11, 4096)) {
        EXPECT_EQ(sample.density > 0.0F, sample.lamp == 2);
        EXPECT_EQ(sample.distance > 0.0F, sample.lamp == 2);
        EXPECT_EQ(sample.probability, sample.lamp == 2 ? 1.0F : 0.0F) << "lamp " << sample.lamp;
    }
}

// No lamp at all: every density is 0, and nothing is NaN.
TEST(LampChoice, StatesZeroWhereNoLampCanBeSampled) {
    const std::vector<Lamp> lamps = {{{0.0F, -3.0F, 0.0F}, 1.0F, 5.0F}, {{0.0F, 0.0F, 0.0F}, 9.0F, 5.0F}};
    for (const Drawn &sample : draw(lamps, {}, 12, 256)) {
        EXPECT_EQ(sample.density, 0.0F);
        EXPECT_EQ(sample.probability, 0.0F);
        EXPECT_EQ(sample.distance, 0.0F);
    }
}

} // namespace
