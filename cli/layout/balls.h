// The balls that a figure shows, where their owners have them.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace cli {

struct Ball {
    glm::dvec3 center;
    double radius;
};

class Balls {
public:
    // More balls behind those that are there. centers: x, y, z of each. radii: of each, or one for all.
    void add(std::span<const double> centers, std::span<const float> radii) {
        parts_.push_back({count_, centers, radii});
        count_ += centers.size() / 3;
    }

    std::size_t count() const { return count_; }

    Ball operator[](std::size_t i) const {
        const auto after = std::upper_bound(parts_.begin(), parts_.end(), i,
                                            [](std::size_t index, const Part &part) { return index < part.first; });
        return (after - 1)->ball(i - (after - 1)->first);
    }

    template <typename Visit>
    void each(Visit visit) const {
        for (const Part &part : parts_) {
            for (std::size_t i = 0; i < part.centers.size() / 3; ++i) {
                visit(part.ball(i));
            }
        }
    }

private:
    struct Part {
        std::size_t first;
        std::span<const double> centers;
        std::span<const float> radii;

        Ball ball(std::size_t i) const {
            return {glm::make_vec3(&centers[3 * i]), static_cast<double>(radii[radii.size() == 1 ? 0 : i])};
        }
    };

    std::vector<Part> parts_;
    std::size_t count_ = 0;
};

} // namespace cli
