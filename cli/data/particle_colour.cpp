#include "cli/data/particle_colour.h"

#include "cli/data/element_data.h"
#include "cli/data/number_colours.h"
#include "cli/data/particle_types.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace cli {
namespace {

// Okabe and Ito 2008, "Color Universal Design", which the colour-blind can tell apart: blue, orange, bluish green,
// vermilion, sky blue, reddish purple, yellow. The order is our own: the first two differ most in lightness too.
constexpr std::array<DisplayColour, 7> type_palette{
    {{0, 114, 178}, {230, 159, 0}, {0, 158, 115}, {213, 94, 0}, {86, 180, 233}, {204, 121, 167}, {240, 228, 66}}};

constexpr std::array<float, 3> plain{0.305F, 0.402F, 0.515F}; // a light bluish grey: #96aabe

const std::array<const char *, 3> component_columns{"red", "green", "blue"};

const std::vector<float> &values_of(const Particles &particles, const std::string &name) {
    return particles.find_column(name)->values; // asked for by ask_for
}

// Where "type" is asked for in vain, "element" has it: automatic colours ask for that.
const ParticleColumn &column_of_types(const Particles &particles, const ParticleColour &colour) {
    const ParticleColumn *found = particles.find_column(colour.columns[0]);
    return found != nullptr ? *found : *particles.find_column(element_column);
}

DisplayColour element_colour(const ElementData &element) {
    const auto byte = [&element](unsigned shift) { return static_cast<std::uint8_t>(element.colour >> shift & 0xffU); };
    return {byte(16), byte(8), byte(0)};
}

// Types are mostly numbered from 1, words from 0.
DisplayColour palette_colour(const ParticleColumn &column, float type) {
    const auto count = static_cast<double>(type_palette.size());
    const double number = column.has_words ? type : type - 1.0;
    return type_palette[static_cast<std::size_t>(number - count * std::floor(number / count))];
}

DisplayColour type_colour(const Particles &particles, const ParticleColumn &column, float type,
                          const ParticleColour &colour) {
    const std::string name = type_name(particles, column, type);
    if (!colour.types.empty()) {
        const auto found = colour.types.find(name);
        if (found == colour.types.end()) {
            throw std::invalid_argument("the type " + name + " is none of those with a colour, " +
                                        names_in(colour.types));
        }
        return found->second;
    }
    const ElementData *element = find_element(name);
    return element != nullptr ? element_colour(*element) : palette_colour(column, type);
}

std::array<double, 2> range_of(const std::vector<float> &values) {
    if (values.empty()) {
        return {0.0, 1.0};
    }
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    return {*least, *largest};
}

std::array<double, 2> range_of_components(const Particles &particles, const ParticleColour &colour) {
    const bool is_beyond_one = std::any_of(colour.columns.begin(), colour.columns.end(), [&](const std::string &name) {
        const std::vector<float> &values = values_of(particles, name);
        return std::any_of(values.begin(), values.end(), [](float x) { return x > 1.0F; });
    });
    return {0.0, is_beyond_one ? 255.0 : 1.0};
}

ParticleColour automatic(const Particles &particles) {
    ParticleColour colour;
    const ParticleColumn *types = particles.find_column(element_column);
    const auto is_there = [&particles](const char *name) { return particles.find_column(name) != nullptr; };
    if (types != nullptr) {
        colour.source = ColourSource::type;
        colour.columns = {types->has_words ? element_column : type_column};
    } else if (std::all_of(component_columns.begin(), component_columns.end(), is_there)) {
        colour.source = ColourSource::components;
        colour.columns.assign(component_columns.begin(), component_columns.end());
    } else {
        colour.source = ColourSource::constant;
        colour.constant = plain;
    }
    return colour;
}

void put_types(const Particles &particles, const ParticleColour &colour, std::vector<std::uint8_t> &bytes) {
    const ParticleColumn &column = column_of_types(particles, colour);
    std::map<float, DisplayColour> by_type;
    for (const float type : types_in(column)) {
        by_type[type] = type_colour(particles, column, type, colour);
    }
    for (const float type : column.values) {
        const DisplayColour &each = by_type.find(type)->second;
        bytes.insert(bytes.end(), each.begin(), each.end());
    }
}

// All of one number have the colour in the middle of the map.
void put_map(const Particles &particles, const ParticleColour &colour, std::vector<std::uint8_t> &bytes) {
    const auto [least, largest] = *colour.range;
    for (const float value : values_of(particles, colour.columns[0])) {
        const double share = largest > least ? (value - least) / (largest - least) : 0.5;
        const DisplayColour mapped = map_colour(colour.map, share);
        bytes.insert(bytes.end(), mapped.begin(), mapped.end());
    }
}

void put_components(const Particles &particles, const ParticleColour &colour, std::vector<std::uint8_t> &bytes) {
    const auto [least, largest] = *colour.range;
    std::array<const float *, 3> columns{};
    std::transform(colour.columns.begin(), colour.columns.end(), columns.begin(),
                   [&](const std::string &name) { return values_of(particles, name).data(); });
    for (std::size_t particle = 0; particle < particles.count(); ++particle) {
        for (const float *column : columns) {
            const double share = std::clamp((column[particle] - least) / (largest - least), 0.0, 1.0);
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0 * share)));
        }
    }
}

} // namespace

void ask_for(const ParticleColour &colour, ParticleQuery &query) {
    query.columns.insert(query.columns.end(), colour.columns.begin(), colour.columns.end());
    if (colour.source == ColourSource::automatic) {
        query.if_present.emplace_back(element_column);
        query.if_present.insert(query.if_present.end(), component_columns.begin(), component_columns.end());
    }
}

ParticleColour resolved(const ParticleColour &colour, const Particles &particles) {
    ParticleColour known = colour.source == ColourSource::automatic ? automatic(particles) : colour;
    if (known.source == ColourSource::map && particles.find_column(known.columns[0])->has_words) {
        known.source = ColourSource::type;
    }
    if (!known.range && known.source == ColourSource::map) {
        known.range = range_of(values_of(particles, known.columns[0]));
    } else if (!known.range && known.source == ColourSource::components) {
        known.range = range_of_components(particles, known);
    }
    return known;
}

std::vector<std::uint8_t> colours_of(const Particles &particles, const ParticleColour &colour) {
    std::vector<std::uint8_t> bytes;
    if (particles.count() == 0 || colour.source == ColourSource::constant) {
        return bytes;
    }
    bytes.reserve(3 * particles.count());
    if (colour.source == ColourSource::type) {
        put_types(particles, colour, bytes);
    } else if (colour.source == ColourSource::map) {
        put_map(particles, colour, bytes);
    } else {
        put_components(particles, colour, bytes);
    }
    return bytes;
}

std::vector<TypeColour> type_colours(const Particles &particles, const ParticleColour &colour) {
    std::vector<TypeColour> colours;
    if (colour.source == ColourSource::type) {
        const ParticleColumn &column = column_of_types(particles, colour);
        for (const float type : types_in(column)) {
            colours.push_back({type_name(particles, column, type), type_colour(particles, column, type, colour)});
        }
    }
    return colours;
}

} // namespace cli
