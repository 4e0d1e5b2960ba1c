#include "cli/data/typical_radius.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace cli {
namespace {

using Cell = glm::vec<3, std::int64_t>;

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

    // Of another place than the particle's own; infinite if there is none near. Rings of cells are looked at until none
    // farther can have a nearer one.
    double nearest_distance(std::size_t particle) const {
        constexpr std::int64_t most_rings = 4;
        const glm::dvec3 place = point(particle);
        const Cell cell = cell_of(place);
        double nearest = std::numeric_limits<double>::infinity();
        for (std::int64_t ring = 0; ring <= most_rings && nearest > side_ * static_cast<double>(ring - 1); ++ring) {
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

    void look_at_ring(const glm::dvec3 &place, const Cell &cell, std::int64_t ring, double &nearest) const {
        for (std::int64_t x = -ring; x <= ring; ++x) {
            for (std::int64_t y = -ring; y <= ring; ++y) {
                const bool is_side = std::abs(x) == ring || std::abs(y) == ring;
                for (std::int64_t z = -ring; z <= ring; z += is_side || ring == 0 ? 1 : 2 * ring) {
                    look_at_cell(place, cell + Cell{x, y, z}, nearest);
                }
            }
        }
    }

    void look_at_cell(const glm::dvec3 &place, const Cell &cell, double &nearest) const {
        const std::uint64_t wanted = key(cell);
        auto entry = std::lower_bound(cells_.begin(), cells_.end(), std::pair{wanted, std::uint32_t{0}});
        for (; entry != cells_.end() && entry->first == wanted; ++entry) {
            const double distance = glm::length(point(entry->second) - place);
            if (distance > 0.0) {
                nearest = std::min(nearest, distance);
            }
        }
    }

    std::span<const double> positions_;
    glm::dvec3 low_;
    double side_ = 1.0;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> cells_; // of each particle, in the order of cells
};

} // namespace

double typical_radius(std::span<const double> positions) {
    constexpr std::size_t most_probes = 2000;
    if (positions.empty()) {
        return 1.0;
    }
    const NeighbourGrid grid(positions);
    const std::size_t step = (grid.count() + most_probes - 1) / most_probes;
    std::vector<double> distances;
    for (std::size_t i = 0; i < grid.count(); i += step) {
        const double distance = grid.nearest_distance(i);
        if (std::isfinite(distance)) {
            distances.push_back(distance);
        }
    }
    if (distances.empty()) {
        return 1.0;
    }
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return 0.5 * *middle;
}

} // namespace cli
