#include "cli/figure/figure_particles.h"

#include "cli/base/exit_code.h"
#include "cli/data/number_colours.h"
#include "cli/data/particle_file.h"
#include "cli/figure/periodic_wrap.h"
#include "cli/figure/vector3.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace cli {
namespace {

// Okabe and Ito 2008, "Color Universal Design", without black and in an order whose first two differ most in lightness
// too; the colour-blind can tell them apart.
constexpr std::array<DisplayColour, 7> type_colours{
    {{0, 114, 178}, {230, 159, 0}, {0, 158, 115}, {213, 94, 0}, {86, 180, 233}, {204, 121, 167}, {240, 228, 66}}};
constexpr DisplayColour plain_colour{150, 170, 190};

// A grid whose cells hold two particles on the average if these fill their box evenly.
class NeighbourGrid {
public:
    explicit NeighbourGrid(const std::vector<double> &positions) : positions_(positions) {
        Vector3 high = point(0);
        low_ = high;
        for (std::size_t i = 0; i < count(); ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low_[axis] = std::min(low_[axis], point(i)[axis]);
                high[axis] = std::max(high[axis], point(i)[axis]);
            }
        }
        const double largest = std::max({high[0] - low_[0], high[1] - low_[1], high[2] - low_[2]});
        double volume = 1.0; // of what has extent, as for a layer in two dimensions
        double dimensions = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (high[axis] - low_[axis] > 1e-6 * largest) {
                volume *= (high[axis] - low_[axis]) / largest;
                dimensions += 1.0;
            }
        }
        side_ =
            dimensions == 0.0 ? 1.0 : largest * std::pow(2.0 * volume / static_cast<double>(count()), 1.0 / dimensions);
        for (std::size_t i = 0; i < count(); ++i) {
            cells_[key(cell_of(point(i)))].push_back(static_cast<std::uint32_t>(i));
        }
    }

    std::size_t count() const { return positions_.size() / 3; }

    // Of another place than the particle's own; infinite if there is none near. Rings of cells are looked at until none
    // farther can have a nearer one.
    double nearest_distance(std::size_t particle) const {
        constexpr std::int64_t most_rings = 4;
        const Vector3 place = point(particle);
        const std::array<std::int64_t, 3> cell = cell_of(place);
        double nearest = std::numeric_limits<double>::infinity();
        for (std::int64_t ring = 0; ring <= most_rings && nearest > side_ * static_cast<double>(ring - 1); ++ring) {
            look_at_ring(place, cell, ring, nearest);
        }
        return nearest;
    }

private:
    Vector3 point(std::size_t i) const { return {positions_[3 * i], positions_[3 * i + 1], positions_[3 * i + 2]}; }

    std::array<std::int64_t, 3> cell_of(const Vector3 &place) const {
        std::array<std::int64_t, 3> cell{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            cell[axis] = static_cast<std::int64_t>(std::floor((place[axis] - low_[axis]) / side_));
        }
        return cell;
    }

    static std::uint64_t key(const std::array<std::int64_t, 3> &cell) {
        constexpr unsigned bits = 21;
        std::uint64_t key = 0;
        for (const std::int64_t index : cell) {
            key = key << bits | (static_cast<std::uint64_t>(index) & ((std::uint64_t{1} << bits) - 1));
        }
        return key;
    }

    void look_at_ring(const Vector3 &place, const std::array<std::int64_t, 3> &cell, std::int64_t ring,
                      double &nearest) const {
        for (std::int64_t x = -ring; x <= ring; ++x) {
            for (std::int64_t y = -ring; y <= ring; ++y) {
                const bool is_side = std::abs(x) == ring || std::abs(y) == ring;
                for (std::int64_t z = -ring; z <= ring; z += is_side || ring == 0 ? 1 : 2 * ring) {
                    look_at_cell(place, {cell[0] + x, cell[1] + y, cell[2] + z}, nearest);
                }
            }
        }
    }

    void look_at_cell(const Vector3 &place, const std::array<std::int64_t, 3> &cell, double &nearest) const {
        const auto found = cells_.find(key(cell));
        if (found == cells_.end()) {
            return;
        }
        for (const std::uint32_t other : found->second) {
            const double distance = length(moved(point(other), -1.0, place));
            if (distance > 0.0) {
                nearest = std::min(nearest, distance);
            }
        }
    }

    const std::vector<double> &positions_;
    Vector3 low_{};
    double side_ = 1.0;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

std::string type_name(const Particles &particles, double type) {
    const auto index = static_cast<std::size_t>(std::max(type, 0.0));
    return index < particles.type_names.size() ? particles.type_names[index]
                                               : std::to_string(static_cast<std::int64_t>(type));
}

void colour_by_type(FigureParticles &particles, const ParticleColumn &types) {
    std::vector<float> known(types.values);
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    particles.palette.clear();
    for (std::size_t i = 0; i < known.size(); ++i) {
        particles.palette.push_back(type_colours[i % type_colours.size()]);
        particles.legend.swatches.push_back({type_name(particles.data, known[i]), particles.palette.back()});
    }
    particles.legend.title = types.name;
    std::transform(types.values.begin(), types.values.end(), particles.colours.begin(), [&](float type) {
        return static_cast<std::uint32_t>(std::lower_bound(known.begin(), known.end(), type) - known.begin());
    });
}

void colour_by_number(FigureParticles &particles, const ParticleColumn &column) {
    constexpr std::size_t colour_count = 256;
    const auto [low, high] = std::minmax_element(column.values.begin(), column.values.end());
    const double least = *low;
    const double range = static_cast<double>(*high) - least;
    particles.palette.clear();
    for (std::size_t i = 0; i < colour_count; ++i) {
        particles.palette.push_back(map_colour("viridis", static_cast<double>(i) / (colour_count - 1)));
    }
    std::transform(column.values.begin(), column.values.end(), particles.colours.begin(), [&](float value) {
        const double share = range > 0.0 ? (value - least) / range : 0.5;
        return static_cast<std::uint32_t>(std::lround(share * (colour_count - 1)));
    });
    particles.legend = {column.name, ColourBar{least, *high, particles.palette}, {}};
}

} // namespace

double typical_radius(const std::vector<double> &positions) {
    constexpr std::size_t most_probes = 2000;
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

FigureParticles read_figure_particles(const FigureOptions &options) {
    ParticleQuery query;
    query.frame = options.frame;
    query.if_present = {"type", "radius"};
    if (!options.color.empty()) {
        query.columns = {options.color};
    }
    FigureParticles particles{};
    particles.data = read_particles(options.data, query);
    if (particles.data.count() == 0) {
        throw Failure(ExitCode::file, options.data + ": has no particles");
    }
    if (options.wraps) {
        wrap_into_box(particles.data);
    }
    const ParticleColumn *radii = particles.data.find_column("radius");
    if (options.radius) {
        particles.radii = {*options.radius};
    } else if (radii != nullptr) {
        particles.radii.assign(radii->values.begin(), radii->values.end());
    } else {
        particles.radii = {typical_radius(particles.data.positions)};
    }
    particles.colours.resize(particles.data.count());
    particles.palette = {plain_colour};
    const ParticleColumn *types = particles.data.find_column("type");
    if (!options.color.empty() && options.color != "type") {
        colour_by_number(particles, *particles.data.find_column(options.color));
    } else if (types != nullptr) {
        colour_by_type(particles, *types);
    }
    return particles;
}

} // namespace cli
