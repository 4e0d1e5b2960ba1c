#include "cli/data/particle_radius.h"

#include "cli/data/element_data.h"
#include "cli/data/particle_types.h"
#include "cli/data/typical_radius.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <stdexcept>

namespace cli {
namespace {

constexpr const char *radius_column = "radius";

const ParticleColumn &radius_types(const Particles &particles, const ParticleRadius &radius) {
    return *particles.find_column(column_named_by(radius.types)); // asked for by ask_for
}

// 0 for what has none.
double element_radius(const std::string &name, RadiusSource source) {
    const ElementData *element = find_element(name);
    return element == nullptr                      ? 0.0
           : source == RadiusSource::van_der_waals ? static_cast<double>(element->van_der_waals_radius)
                                                   : static_cast<double>(element->covalent_radius);
}

double radius_of_type(const std::string &name, const ParticleRadius &radius) {
    if (radius.source != RadiusSource::types) {
        const double known = element_radius(name, radius.source);
        if (!(known > 0.0)) {
            throw std::invalid_argument("the type " + name + ": must be an element whose radius is known");
        }
        return known;
    }
    const auto found = radius.types.find(name);
    if (found == radius.types.end()) {
        throw std::invalid_argument("the type " + name + " is none of those with a radius, " + names_in(radius.types));
    }
    return found->second;
}

std::vector<float> radii_of_types(const Particles &particles, const ParticleRadius &radius) {
    const ParticleColumn &column = radius_types(particles, radius);
    std::map<float, float> by_type;
    for (const float type : types_in(column)) {
        by_type[type] = static_cast<float>(radius.scale * radius_of_type(type_name(particles, column, type), radius));
    }
    std::vector<float> radii;
    radii.reserve(column.values.size());
    std::transform(column.values.begin(), column.values.end(), std::back_inserter(radii),
                   [&by_type](float type) { return by_type.find(type)->second; });
    return radii;
}

// Whether all are elements whose neighbours are apart as angstroms have it: a bond is as long as the two covalent
// radii, in a solid without bonds up to thrice that, and 16 times in a gas at 0 degrees and 1 bar.
bool has_elements_in_angstroms(const Particles &particles, const ParticleColumn &column, double typical) {
    double least = 0.0;
    double largest = 0.0;
    for (const float type : types_in(column)) {
        const double radius =
            column.has_words ? element_radius(type_name(particles, column, type), RadiusSource::covalent) : 0.0;
        if (!(radius > 0.0)) {
            return false;
        }
        least = least > 0.0 ? std::min(least, radius) : radius;
        largest = std::max(largest, radius);
    }
    constexpr double closest = 0.7;
    constexpr double farthest = 30.0;
    return closest * least <= typical && typical <= farthest * largest;
}

} // namespace

void ask_for(const ParticleRadius &radius, ParticleQuery &query) {
    switch (radius.source) {
    case RadiusSource::automatic:
        query.if_present.emplace_back(radius_column);
        query.if_present.emplace_back(element_column);
        break;
    case RadiusSource::constant:
        break;
    case RadiusSource::column:
        query.columns.push_back(radius.column);
        break;
    default:
        query.columns.emplace_back(column_named_by(radius.types));
        break;
    }
}

ParticleRadius resolved(const ParticleRadius &radius, const Particles &particles) {
    if (radius.source != RadiusSource::automatic) {
        return radius;
    }
    if (particles.find_column(radius_column) != nullptr) {
        return {RadiusSource::column, radius.scale, radius_column, {}};
    }
    const double typical = typical_radius(particles.positions);
    const ParticleColumn *types = particles.find_column(element_column);
    if (types != nullptr && has_elements_in_angstroms(particles, *types, typical)) {
        return {RadiusSource::covalent, radius.scale, {}, {}};
    }
    return {RadiusSource::constant, radius.scale * typical, {}, {}};
}

std::vector<float> radii_of(const Particles &particles, const ParticleRadius &radius) {
    if (radius.source == RadiusSource::constant) {
        return {static_cast<float>(radius.scale)};
    }
    if (radius.source != RadiusSource::column) {
        return radii_of_types(particles, radius);
    }
    std::vector<float> radii = particles.find_column(radius.column)->values;
    for (float &value : radii) {
        value *= static_cast<float>(radius.scale);
    }
    return radii;
}

} // namespace cli
