// What a pixel sees of a diffuse floor under spherical lamps, in closed form over a quadrature of the pixel and of
// time. Used by the tests that render such scenes.
#pragma once

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <span>

struct FloorLamp {
    glm::dvec3 centre;
    double radius;
    double radiance;
    glm::dvec3 motion{0};
};

// Mean radiance of a pixel of CourseworkScene::camera() that sees nothing but the floor y = -1, of diffuse albedo
// 0.8, lit by lamps wholly above it and in full sight. The irradiance of a uniform sphere is that of the point at its
// centre with its power: pi L (r / d)^2 cos (Snyder 1996); reflected, albedo / pi times that. Gauss-Legendre with 2
// nodes in each of cells of the pixel's sides and of time: the error is below cells^-4 / 4320 times the fourth
// derivative.
inline double floor_radiance(std::span<const FloorLamp> lamps, uint32_t width, uint32_t height, uint32_t column,
                             uint32_t row, int cells = 16) {
    const auto node = [&](int i) { return (i / 2 + 0.5 + (i % 2 == 0 ? -0.5 : 0.5) / std::sqrt(3.0)) / cells; };
    const int nodes = 2 * cells;
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < nodes; ++i)
        for (int j = 0; j < nodes; ++j) {
            const glm::dvec3 direction((column + node(i) - 0.5 * width) / height, 0.5 - (row + node(j)) / height, -1.0);
            const glm::dvec3 point = glm::dvec3(0, 0, 1) - direction / direction.y;
            for (const FloorLamp &lamp : lamps) {
                const int times = lamp.motion == glm::dvec3(0) ? 1 : nodes;
                for (int k = 0; k < times; ++k) {
                    const glm::dvec3 to_lamp = lamp.centre + (times == 1 ? 0.0 : node(k)) * lamp.motion - point;
                    const double distance = glm::length(to_lamp);
                    sum += 0.8 * lamp.radiance * lamp.radius * lamp.radius * to_lamp.y / std::pow(distance, 3) / times;
                }
            }
            ++count;
        }
    return sum / count;
}
