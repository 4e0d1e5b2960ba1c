// The balls that a figure shows, where their owner has them.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <span>

namespace cli {

struct Ball {
    glm::dvec3 center;
    double radius;
};

class Balls {
public:
    // centers: x, y, z of each. radii: of each, or one for all.
    Balls(std::span<const double> centers, std::span<const double> radii) : centers_(centers), radii_(radii) {}

    std::size_t count() const { return centers_.size() / 3; }

    Ball operator[](std::size_t i) const {
        return {{centers_[3 * i], centers_[3 * i + 1], centers_[3 * i + 2]}, radii_[radii_.size() == 1 ? 0 : i]};
    }

private:
    std::span<const double> centers_;
    std::span<const double> radii_;
};

} // namespace cli
