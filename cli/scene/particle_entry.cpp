#include "cli/scene/particle_entry.h"

#include "cli/data/periodic_wrap.h"

#include <cstdio>
#include <stdexcept>
#include <utility>

namespace cli {
namespace {

template <typename Work>
void look_for(const ParticleEntry &entry, const std::string &path, bool of_radius, Work work) {
    try {
        work();
    } catch (const std::invalid_argument &error) {
        throw RefusedLook(entry.query.blame, path + ": " + error.what(), of_radius);
    }
}

} // namespace

pt_sphere_array ParticleEntry::spheres() const {
    pt_sphere_array array{};
    array.struct_size = sizeof array;
    array.count = static_cast<std::uint32_t>(count());
    array.center = {positions.data(), 3 * sizeof(double), PT_TYPE_FLOAT64};
    array.radius = {radii.data(), radii.size() > 1 ? static_cast<std::uint32_t>(sizeof(float)) : 0U, PT_TYPE_FLOAT32};
    array.material = {&material, 0, PT_TYPE_UINT32};
    array.color = colours.empty() ? pt_column{shown_colour.constant.data(), 0, PT_TYPE_FLOAT32}
                                  : pt_column{colours.data(), 3, PT_TYPE_SRGB8};
    return array;
}

std::string ParticleEntry::chosen_range() const {
    if (colour.range || shown_colour.source != ColourSource::map || count() == 0) {
        return {};
    }
    const auto [least, largest] = *shown_colour.range;
    std::array<char, 64> numbers{};
    std::snprintf(numbers.data(), numbers.size(), " from %.6g to %.6g", least, largest);
    return shown_colour.columns[0] + numbers.data();
}

void load(ParticleEntry &entry, const std::string &path) {
    ParticleQuery query = entry.query;
    ask_for(entry.radius, query);
    ask_for(entry.colour, query);
    Particles particles = read_particles(path, query);
    if (entry.wraps) {
        wrap_into_box(particles, path);
    }
    entry.shown_radius = resolved(entry.radius, particles);
    entry.shown_colour = resolved(entry.colour, particles);
    look_for(entry, path, true, [&] { entry.radii = radii_of(particles, entry.shown_radius); });
    look_for(entry, path, false, [&] {
        entry.colours = colours_of(particles, entry.shown_colour);
        entry.types = type_colours(particles, entry.shown_colour);
    });
    entry.box = particles.box;
    entry.positions = std::move(particles.positions);
}

} // namespace cli
