#include "cli/figure/figure_particles.h"

#include "cli/base/exit_code.h"
#include "cli/data/number_colours.h"
#include "cli/data/particle_file.h"
#include "cli/data/periodic_wrap.h"
#include "cli/data/typical_radius.h"

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
