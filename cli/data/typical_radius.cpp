#include "cli/data/typical_radius.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace cli {
namespace {

using Cell = glm::vec<3, std::int64_t>;

// To the neighbours of a particle.
using Distances = std::array<double, 4>;

// A grid whose cells hold two particles on the average if these fill their box evenly.
class NeighbourGrid {
public:
    explicit NeighbourGrid(std::span<const double> positions) : positions_(positions), low_(point(0)) {
        glm::dvec3 high = low_;
        for (std::size_t i = 0; i < count(); ++i) {
            low_ = glm::min(low_, point(i));
            high = glm::max(high, point(i));
        }
        side_ = side_of_cells(high - low_);
        cells_.reserve(count());
        for (std::size_t i = 0; i < count(); ++i) {
            cells_.emplace_back(key(cell_of(point(i))), static_cast<std::uint32_t>(i));
        }
        std::sort(cells_.begin(), cells_.end());
    }

    std::size_t count() const { return positions_.size() / 3; }

    // Of other places than the particle's own, in ascending order; infinite where there are none near. Rings of cells
    // are looked at until none farther can have a nearer one.
    Distances nearest_distances(std::size_t particle) const {
        constexpr std::int64_t most_rings = 4;
        const glm::dvec3 place = point(particle);
        const Cell cell = cell_of(place);
        Distances nearest;
        nearest.fill(std::numeric_limits<double>::infinity());
        for (std::int64_t ring = 0; ring <= most_rings && nearest.back() > side_ * static_cast<double>(ring - 1);
             ++ring) {
            look_at_ring(place, cell, ring, nearest);
        }
        return nearest;
    }

private:
    glm::dvec3 point(std::size_t i) const { return glm::make_vec3(&positions_[3 * i]); }

    // A layer in two dimensions, or a row in one, has no volume: what has no extent does not count.
    double side_of_cells(const glm::dvec3 &extents) const {
        const double largest = std::max({extents.x, extents.y, extents.z});
        double volume = 1.0;
        double dimensions = 0.0;
        for (const double extent : {extents.x, extents.y, extents.z}) {
            if (extent > 1e-6 * largest) {
                volume *= extent / largest;
                dimensions += 1.0;
            }
        }
        return dimensions == 0.0 ? 1.0
                                 : largest * std::pow(2.0 * volume / static_cast<double>(count()), 1.0 / dimensions);
    }

    Cell cell_of(const glm::dvec3 &place) const { return {glm::floor((place - low_) / side_)}; }

    static std::uint64_t key(const Cell &cell) {
        constexpr unsigned bits = 21;
        constexpr std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
        return (static_cast<std::uint64_t>(cell.x) & mask) << 2 * bits |
               (static_cast<std::uint64_t>(cell.y) & mask) << bits | (static_cast<std::uint64_t>(cell.z) & mask);
    }

    void look_at_ring(const glm::dvec3 &place, const Cell &cell, std::int64_t ring, Distances &nearest) const {
        for (std::int64_t x = -ring; x <= ring; ++x) {
            for (std::int64_t y = -ring; y <= ring; ++y) {
                const bool is_side = std::abs(x) == ring || std::abs(y) == ring;
                for (std::int64_t z = -ring; z <= ring; z += is_side || ring == 0 ? 1 : 2 * ring) {
                    look_at_cell(place, cell + Cell{x, y, z}, nearest);
                }
            }
        }
    }

    void look_at_cell(const glm::dvec3 &place, const Cell &cell, Distances &nearest) const {
        const std::uint64_t wanted = key(cell);
        auto entry = std::lower_bound(cells_.begin(), cells_.end(), std::pair{wanted, std::uint32_t{0}});
        for (; entry != cells_.end() && entry->first == wanted; ++entry) {
            const double distance = glm::length(point(entry->second) - place);
            if (distance > 0.0 && distance < nearest.back()) {
                nearest.back() = distance;
                std::sort(nearest.begin(), nearest.end());
            }
        }
    }

    std::span<const double> positions_;
    glm::dvec3 low_;
    double side_ = 1.0;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> cells_; // of each particle, in the order of cells
};

double quantile(std::vector<double> &values, double share) {
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

} // namespace

double typical_radius(std::span<const double> positions) {
    constexpr std::size_t most_probes = 2000;
    if (positions.empty()) {
        return 1.0;
    }
    const NeighbourGrid grid(positions);
    const std::size_t step = (grid.count() + most_probes - 1) / most_probes;
    std::vector<double> nearest;
    std::vector<double> fourth;
    for (std::size_t i = 0; i < grid.count(); i += step) {
        const Distances distances = grid.nearest_distances(i);
        if (std::isfinite(distances.front())) {
            nearest.push_back(distances.front());
        }
        if (std::isfinite(distances.back())) {
            fourth.push_back(distances.back());
        }
    }
    if (nearest.empty()) {
        return 1.0;
    }
    const double median = quantile(nearest, 0.5);
    // Of points at random a twentieth has its nearest neighbour at 0.27 of the median on a surface, and at 0.42 in
    // space (0.051 = -log(0.95) and 0.69 = -log(0.5): their ratio's square and cube root); atoms have none at half of
    // it.
    const bool is_at_random = quantile(nearest, 0.05) < 0.5 * median;
    return 0.5 * (is_at_random && !fourth.empty() ? quantile(fourth, 0.5) : median);
}

} // namespace cli
