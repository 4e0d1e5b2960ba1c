// Random directions, drawn on the device by the shipped functions: the right distribution, by chi-square.
// tests/device/accuracy/ compares single directions. Run alone with --gtest_filter=Direction*.
#include "directions.spv.h"
#include "tests/device/probe.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace {

enum Kind : std::uint32_t { uniform_sphere, uniform_hemisphere, cosine_hemisphere, phong_lobe };

struct Case {
    const char *name;
    Kind kind;
    glm::dvec3 axis;
    double exponent; // of the lobe
};

constexpr std::uint32_t direction_samples = 1U << 20;

std::vector<glm::vec4> draw(const Case &test_case, std::uint32_t seed) {
    struct {
        glm::vec4 axis;
        std::uint32_t kind;
        float glossiness;
        std::uint32_t seed, count;
    } push{glm::vec4(glm::normalize(test_case.axis), 0.0F), test_case.kind, static_cast<float>(test_case.exponent),
           seed, direction_samples};
    return Probe(directions_spirv(), sizeof push).run<glm::vec4>({}, direction_samples, push, direction_samples);
}

// P(cosine of the angle to the axis < c) for each kind; uniform_sphere takes the z axis.
double cumulated(const Case &test_case, double c) {
    switch (test_case.kind) {
    case uniform_sphere:
        return 0.5 * (1.0 + c);
    case uniform_hemisphere:
        return c;
    case cosine_hemisphere:
        return c * c;
    default:
        return std::pow(c, test_case.exponent + 1.0);
    }
}

// The cosine below which a share of the directions lies: the inverse of cumulated().
double quantile(const Case &test_case, double share) {
    switch (test_case.kind) {
    case uniform_sphere:
        return 2.0 * share - 1.0;
    case uniform_hemisphere:
        return share;
    case cosine_hemisphere:
        return std::sqrt(share);
    default:
        return std::pow(share, 1.0 / (test_case.exponent + 1.0));
    }
}

// Chi-square deviate of directions over bands x sectors cells of equal probability about the axis; the axis of the
// hemisphere points into the middle of a cell's border nowhere but at its pole.
double deviate(const Case &test_case, const std::vector<glm::vec4> &directions) {
    constexpr int bands = 31;
    constexpr int sectors = 33;
    const glm::dvec3 axis = test_case.kind == uniform_sphere ? glm::dvec3(0, 0, 1) : glm::normalize(test_case.axis);
    const glm::dvec3 helper = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 tangent = glm::normalize(glm::cross(axis, helper));
    const glm::dvec3 bitangent = glm::cross(axis, tangent);
    std::vector<double> bounds(bands - 1);
    for (int i = 0; i < bands - 1; ++i)
        bounds[i] = quantile(test_case, (i + 1.0) / bands);

    std::vector<double> observed(bands * sectors);
    for (const glm::vec4 &drawn : directions) {
        const glm::dvec3 direction(drawn);
        const auto band = std::upper_bound(bounds.begin(), bounds.end(), glm::dot(direction, axis)) - bounds.begin();
        const double azimuth = std::atan2(glm::dot(direction, bitangent), glm::dot(direction, tangent));
        const int sector =
            std::min(static_cast<int>((azimuth / (2.0 * std::numbers::pi) + 0.5) * sectors), sectors - 1);
        ++observed[static_cast<std::size_t>(band * sectors + sector)];
    }
    const std::vector<double> expected(observed.size(), static_cast<double>(direction_samples) / (bands * sectors));
    return statistics::chi_square_deviate(observed, expected);
}

// One false alarm in a million, over the cases of this file together.
const double direction_bound = statistics::normal_quantile(1e-6 / 10);

class Directions : public testing::TestWithParam<Case> {};

TEST_P(Directions, FollowTheirDensity) {
    EXPECT_LT(deviate(GetParam(), draw(GetParam(), 2)), direction_bound);
    // Negative control: an inverse mapping wrong by 3% in the polar cosine must not pass.
    std::vector<glm::vec4> wrong = draw(GetParam(), 2);
    const glm::dvec3 axis = GetParam().kind == uniform_sphere ? glm::dvec3(0, 0, 1) : glm::normalize(GetParam().axis);
    for (glm::vec4 &drawn : wrong) {
        const glm::dvec3 direction(drawn);
        const double cosine = glm::dot(direction, axis);
        const double share = cumulated(GetParam(), cosine);
        const double moved = quantile(GetParam(), std::clamp(std::pow(share, 1.03), 0.0, 1.0));
        const glm::dvec3 across = direction - cosine * axis;
        const double sine = glm::length(across);
        if (sine > 0.0)
            drawn =
                glm::vec4(glm::vec3(moved * axis + std::sqrt(std::max(0.0, 1.0 - moved * moved)) / sine * across), 0);
    }
    EXPECT_GT(deviate(GetParam(), wrong), direction_bound);
}

INSTANTIATE_TEST_SUITE_P(AllSamplers, Directions,
                         testing::Values(Case{"UniformSphere", uniform_sphere, {0, 0, 1}, 0},
                                         Case{"UniformHemisphere", uniform_hemisphere, {1, -2, 0.5}, 0},
                                         Case{"CosineHemisphere", cosine_hemisphere, {0.3, 0.5, -2}, 0},
                                         Case{"CosineHemisphereDown", cosine_hemisphere, {0, 0, -1}, 0},
                                         Case{"PhongLobe0", phong_lobe, {0, 1, 0}, 0},
                                         Case{"PhongLobe1", phong_lobe, {0, 1, 0}, 1},
                                         Case{"PhongLobe40", phong_lobe, {-1, 1, 1}, 40},
                                         Case{"PhongLobe3000", phong_lobe, {1, 2, 3}, 3000}),
                         [](const auto &param) { return std::string(param.param.name); });

} // namespace
