#pragma once

#include "tests/accuracy/comparison.h"

#include <cmath>
#include <cstdint>
#include <random>

namespace accuracy {

constexpr std::size_t random_count = 10000;

class Inputs {
public:
    explicit Inputs(std::uint32_t seed) : generator_(seed) {}

    std::uint32_t word() { return static_cast<std::uint32_t>(generator_()); }

    // Returns a multiple of 2^-24 in [0, 1), like the sampler. One in sixteen is among the four smallest or four
    // largest values.
    float number() {
        const std::uint32_t bits = word() >> 8;
        const std::uint32_t choice = word();
        const std::uint32_t extreme = (choice & 64U) != 0 ? choice & 3U : 0xffffffU - (choice & 3U);
        return static_cast<float>((choice & 0xf00U) == 0 ? extreme : bits) * 0x1p-24F;
    }

    double log_uniform(double low, double high) { return low * std::pow(high / low, word() * 0x1p-32); }

    glm::vec3 direction() {
        const std::uint32_t choice = word();
        glm::dvec3 vector(normal(), normal(), normal());
        if (choice % 8 == 0) {
            glm::dvec3 axis(0.0);
            axis[static_cast<int>(choice / 8 % 3)] = (choice & 0x100U) != 0 ? 1.0 : -1.0;
            const std::uint32_t nearness = choice >> 16 & 31U;
            vector = axis + (nearness < 28 ? std::ldexp(1.0, -static_cast<int>(nearness) - 1) : 0.0) * vector;
        }
        return {glm::normalize(vector)};
    }

private:
    double normal() { // std::normal_distribution is not portable
        double sum = 0.0;
        for (int i = 0; i < 12; ++i)
            sum += word() * 0x1p-32;
        return sum - 6.0;
    }

    std::mt19937 generator_;
};

inline Real length_error(const glm::vec3 &vector) {
    return std::abs(glm::length(Direction(vector)) - 1);
}

} // namespace accuracy
