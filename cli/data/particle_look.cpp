#include "cli/data/particle_look.h"

#include "cli/data/element_data.h"
#include "cli/data/number_colours.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace cli {
namespace {

constexpr const char *type_column = "type";

// Okabe and Ito 2008, "Color Universal Design": orange, sky blue, bluish green, yellow, blue, vermilion, reddish
// purple.
constexpr std::array<std::uint32_t, 7> type_palette{0xe69f00, 0x56b4e9, 0x009e73, 0xf0e442,
                                                    0x0072b2, 0xd55e00, 0xcc79a7};

const std::vector<float> &values_of(const Particles &particles, const std::string &name) {
    return particles.find_column(name)->values; // asked for by look_columns
}

float element_radius(const Particles &particles, std::size_t type, RadiusSource source) {
    const std::string &name = particles.type_names[type];
    const ElementData *element = find_element(name);
    const float radius = element == nullptr                      ? 0.0F
                         : source == RadiusSource::van_der_waals ? element->van_der_waals_radius
                                                                 : element->covalent_radius;
    if (!(radius > 0.0F)) {
        throw std::invalid_argument("the type " + name + ": must be an element whose radius is known");
    }
    return radius;
}

std::vector<float> element_radii(const Particles &particles, const ParticleRadius &radius) {
    if (particles.type_names.empty() && particles.count() > 0) {
        throw std::invalid_argument("the types are numbers: only symbols of elements have radii");
    }
    std::vector<float> by_type;
    for (std::size_t type = 0; type < particles.type_names.size(); ++type) {
        by_type.push_back(static_cast<float>(radius.scale) * element_radius(particles, type, radius.source));
    }
    std::vector<float> radii = values_of(particles, type_column);
    std::transform(radii.begin(), radii.end(), radii.begin(),
                   [&by_type](float type) { return by_type[static_cast<std::size_t>(type)]; });
    return radii;
}

std::uint32_t type_colour(const Particles &particles, float type) {
    const bool is_named = !particles.type_names.empty();
    const ElementData *element =
        is_named ? find_element(particles.type_names[static_cast<std::size_t>(type)]) : nullptr;
    if (element != nullptr) {
        return element->colour;
    }
    const double turn = std::fmod(std::abs(static_cast<double>(type)), type_palette.size());
    return type_palette[static_cast<std::size_t>(turn)];
}

std::array<double, 2> range_of(const std::vector<float> &values) {
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    return {*least, *largest};
}

void put_types(const Particles &particles, std::vector<std::uint8_t> &colours) {
    for (const float type : values_of(particles, type_column)) {
        const std::uint32_t colour = type_colour(particles, type);
        for (const int shift : {16, 8, 0}) {
            colours.push_back(static_cast<std::uint8_t>(colour >> shift & 0xffU));
        }
    }
}

void put_map(const Particles &particles, const ParticleColour &colour, std::vector<std::uint8_t> &colours) {
    const std::vector<float> &values = values_of(particles, colour.columns[0]);
    const auto [least, largest] = colour.range ? *colour.range : range_of(values);
    const double width = largest > least ? largest - least : 1.0;
    for (const float value : values) {
        const auto mapped = map_colour(colour.map, (value - least) / width);
        colours.insert(colours.end(), mapped.begin(), mapped.end());
    }
}

void put_components(const Particles &particles, const ParticleColour &colour, std::vector<std::uint8_t> &colours) {
    std::array<const float *, 3> columns{};
    bool is_beyond_one = false;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::vector<float> &values = values_of(particles, colour.columns[i]);
        columns[i] = values.data();
        is_beyond_one = is_beyond_one || std::any_of(values.begin(), values.end(), [](float x) { return x > 1.0F; });
    }
    const auto [least, largest] = colour.range.value_or(std::array<double, 2>{0.0, is_beyond_one ? 255.0 : 1.0});
    for (std::size_t particle = 0; particle < particles.count(); ++particle) {
        for (const float *column : columns) {
            const double share = std::clamp((column[particle] - least) / (largest - least), 0.0, 1.0);
            colours.push_back(static_cast<std::uint8_t>(std::lround(255.0 * share)));
        }
    }
}

} // namespace

std::vector<std::string> look_columns(const ParticleRadius &radius, const ParticleColour &colour) {
    std::vector<std::string> columns = colour.columns;
    if (radius.source == RadiusSource::column) {
        columns.push_back(radius.column);
    }
    const bool by_element = radius.source == RadiusSource::van_der_waals || radius.source == RadiusSource::covalent;
    if (by_element || colour.source == ColourSource::type) {
        columns.emplace_back(type_column);
    }
    return columns;
}

std::vector<float> radii_of(const Particles &particles, const ParticleRadius &radius) {
    if (radius.source == RadiusSource::constant) {
        return {static_cast<float>(radius.scale)};
    }
    if (radius.source != RadiusSource::column) {
        return element_radii(particles, radius);
    }
    std::vector<float> radii = values_of(particles, radius.column);
    for (float &value : radii) {
        value *= static_cast<float>(radius.scale);
    }
    return radii;
}

std::vector<std::uint8_t> colours_of(const Particles &particles, const ParticleColour &colour) {
    std::vector<std::uint8_t> colours;
    if (particles.count() == 0 || colour.source == ColourSource::constant) {
        return colours;
    }
    colours.reserve(3 * particles.count());
    if (colour.source == ColourSource::type) {
        put_types(particles, colours);
    } else if (colour.source == ColourSource::map) {
        put_map(particles, colour, colours);
    } else {
        put_components(particles, colour, colours);
    }
    return colours;
}

} // namespace cli
