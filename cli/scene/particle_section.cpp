#include "cli/scene/particle_section.h"

#include "cli/base/suggestion.h"
#include "cli/data/number_colours.h"
#include "cli/scene/scene_file.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace cli {
namespace {

using nlohmann::json;

std::string text_of(const json &value, const JsonPlace &place) {
    return std::string(read_text(value, place));
}

// A length for all; {"column": name} or {"elements": "covalent"}, both with a scale if there is one.
ParticleRadius read_radius(const json &value, const JsonPlace &place) {
    ParticleRadius radius;
    if (!value.is_object()) {
        radius.scale = read_number(value, place);
        return radius;
    }
    const JsonObject object(value, place, {"column", "elements", "scale"});
    const json *column = object.find("column");
    const json *elements = object.find("elements");
    if ((column == nullptr) == (elements == nullptr)) {
        refuse(place, "must be a number or have either \"column\" or \"elements\"");
    }
    if (column != nullptr) {
        radius.source = RadiusSource::column;
        radius.column = text_of(*column, place.member("column"));
    } else {
        const std::string name = text_of(*elements, place.member("elements"));
        if (name != "van-der-waals" && name != "covalent") {
            refuse(place.member("elements"), "must be van-der-waals or covalent");
        }
        radius.source = name == "covalent" ? RadiusSource::covalent : RadiusSource::van_der_waals;
    }
    if (const json *scale = object.find("scale")) {
        radius.scale = read_number(*scale, place.member("scale"));
    }
    return radius;
}

void read_columns(ParticleColour &colour, const json &value, const JsonPlace &place) {
    if (!value.is_array() || value.size() != 3) {
        refuse(place, "must be an array of the names of red, green and blue");
    }
    colour.source = ColourSource::components;
    for (std::size_t i = 0; i < 3; ++i) {
        colour.columns.push_back(text_of(value[i], place.element(i)));
    }
}

// A colour for all; "type"; {"columns": [red, green, blue]}; or {"column": name, "map": "viridis"}, both with a range.
ParticleColour read_look_colour(const json &value, const JsonPlace &place) {
    ParticleColour colour;
    if (value.is_string()) {
        if (read_text(value, place) != "type") {
            refuse(place, "must be a colour, \"type\", or an object with \"column\" or \"columns\"");
        }
        colour.source = ColourSource::type;
        return colour;
    }
    if (!value.is_object()) {
        colour.constant = read_colour(value, place);
        return colour;
    }
    const JsonObject object(value, place, {"column", "columns", "map", "range"});
    const json *column = object.find("column");
    const json *columns = object.find("columns");
    if ((column == nullptr) == (columns == nullptr)) {
        refuse(place, "must have either \"column\" or \"columns\"");
    }
    if (columns != nullptr) {
        read_columns(colour, *columns, place.member("columns"));
    } else {
        colour.source = ColourSource::map;
        colour.columns.push_back(text_of(*column, place.member("column")));
    }
    if (const json *map = object.find("map")) {
        colour.map = text_of(*map, place.member("map"));
        if (std::find(colour_map_names.begin(), colour_map_names.end(), colour.map) == colour_map_names.end()) {
            refuse(place.member("map"), unknown_name("map", colour.map, colour_map_names));
        }
    }
    if (const json *range = object.find("range")) {
        colour.range = read_pair(*range, place.member("range"));
        if (!((*colour.range)[0] < (*colour.range)[1])) {
            refuse(place.member("range"), "must be [least, largest], and the largest must be larger");
        }
    }
    return colour;
}

ParticleQuery read_query(const JsonObject &object, const JsonPlace &place) {
    ParticleQuery query;
    query.blame = ExitCode::scene;
    if (const json *format = object.find("format")) {
        query.format = text_of(*format, place.member("format"));
        if (std::find(particle_formats.begin(), particle_formats.end(), query.format) == particle_formats.end()) {
            refuse(place.member("format"), unknown_name("format", query.format, particle_formats));
        }
    }
    if (const json *frame = object.find("frame")) {
        if (!frame->is_number_integer()) {
            refuse(place.member("frame"), "must be a whole number; -1 is the last frame");
        }
        query.frame = frame->get<std::int64_t>();
    }
    if (const json *where = object.find("where")) {
        const JsonPlace conditions = place.member("where");
        if (!where->is_array()) {
            refuse(conditions, "must be an array of conditions like \"z < 5\"");
        }
        for (std::size_t i = 0; i < where->size(); ++i) {
            query.where.push_back(text_of((*where)[i], conditions.element(i)));
        }
    }
    return query;
}

void load(const SceneFile &scene, ParticleEntry &entry) {
    ParticleQuery query = entry.query;
    query.columns = look_columns(entry.radius, entry.colour);
    const std::string path = particle_path(scene, entry);
    Particles particles = read_particles(path, query);
    try {
        entry.radii = radii_of(particles, entry.radius);
        entry.colours = colours_of(particles, entry.colour);
    } catch (const std::invalid_argument &error) {
        throw Failure(ExitCode::scene, path + ": " + error.what());
    }
    entry.positions = std::move(particles.positions);
}

} // namespace

pt_sphere_array ParticleEntry::spheres() const {
    pt_sphere_array array{};
    array.struct_size = sizeof array;
    array.count = static_cast<std::uint32_t>(positions.size() / 3);
    array.center = {positions.data(), 3 * sizeof(double), PT_TYPE_FLOAT64};
    array.radius = {radii.data(), radii.size() > 1 ? static_cast<std::uint32_t>(sizeof(float)) : 0U, PT_TYPE_FLOAT32};
    array.material = {&material, 0, PT_TYPE_UINT32};
    array.color = colours.empty() ? pt_column{colour.constant.data(), 0, PT_TYPE_FLOAT32}
                                  : pt_column{colours.data(), 3, PT_TYPE_SRGB8};
    return array;
}

ParticleEntry read_particle_entry(const JsonPlace &place, const json &value) {
    const JsonObject object(value, place, {"file", "format", "frame", "where", "radius", "color", "material"});
    ParticleEntry entry;
    entry.file = text_of(object.require("file"), place.member("file"));
    entry.query = read_query(object, place);
    entry.radius = read_radius(object.require("radius"), place.member("radius"));
    if (const json *colour = object.find("color")) {
        entry.colour = read_look_colour(*colour, place.member("color"));
    }
    return entry;
}

void load_particles(SceneFile &scene) {
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        try {
            load(scene, scene.particles[i]);
        } catch (const Failure &failure) {
            throw Failure(failure.code(), scene.path + ": particles[" + std::to_string(i) + "]: " + failure.what());
        }
    }
}

std::string particle_path(const SceneFile &scene, const ParticleEntry &entry) {
    return (std::filesystem::path(scene.path).parent_path() / entry.file).string();
}

} // namespace cli
