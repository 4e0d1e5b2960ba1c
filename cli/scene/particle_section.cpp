#include "cli/scene/particle_section.h"

#include "cli/base/message.h"
#include "cli/base/suggestion.h"
#include "cli/data/number_colours.h"
#include "cli/data/particle_types.h"
#include "cli/image/tone_map.h"
#include "cli/scene/scene_file.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <span>

namespace cli {
namespace {

using nlohmann::json;

std::string text_of(const json &value, const JsonPlace &place) {
    return std::string(read_text(value, place));
}

using Keys = std::span<const char *const>;

std::string any_of(Keys keys) {
    std::string text;
    for (const char *key : keys) {
        text.append(text.empty() ? "" : key == keys.back() ? " or " : ", ").append("\"").append(key).append("\"");
    }
    return text;
}

// The only one of these keys that the object has; nullptr if it has none, or several.
const char *only_key(const JsonObject &object, Keys keys) {
    const char *found = nullptr;
    for (const char *key : keys) {
        if (object.find(key) != nullptr) {
            if (found != nullptr) {
                return nullptr;
            }
            found = key;
        }
    }
    return found;
}

template <typename Read>
auto read_types(const json &value, const JsonPlace &place, Read read) {
    if (!value.is_object() || value.empty()) {
        refuse(place, "must be an object with a value for each type");
    }
    std::map<std::string, decltype(read(value, place))> types;
    for (const auto &[name, each] : value.items()) {
        types.emplace(name, read(each, place.member(name)));
    }
    return types;
}

// Refused here, as the library sees only what is of a type that there is.
double read_type_radius(const json &value, const JsonPlace &place) {
    const double radius = read_number(value, place);
    if (!(radius > 0.0)) {
        refuse(place, "must be > 0, is " + value.dump());
    }
    return radius;
}

DisplayColour read_type_colour(const json &value, const JsonPlace &place) {
    const std::array<float, 3> light = read_colour(value, place);
    if (std::any_of(light.begin(), light.end(), [](float each) { return !(each >= 0.0F && each <= 1.0F); })) {
        refuse(place, "must be from 0 to 1, is " + value.dump());
    }
    const std::vector<std::uint8_t> bytes = map_to_8_bits(light, {});
    return {bytes[0], bytes[1], bytes[2]};
}

// A length for all; {"column": name}, {"elements": "covalent"} or {"types": {"H": 0.3}}, with a scale if there is one.
ParticleRadius read_radius(const json &value, const JsonPlace &place) {
    ParticleRadius radius;
    if (!value.is_object()) {
        radius.source = RadiusSource::constant;
        radius.scale = read_number(value, place);
        return radius;
    }
    const JsonObject object(value, place, {"column", "elements", "types", "scale"});
    static constexpr std::array<const char *, 3> keys{"column", "elements", "types"};
    const char *found = only_key(object, keys);
    if (found == nullptr) {
        refuse(place, "must be a number, or have one of " + any_of(keys));
    }
    const json &by = object.require(found);
    const JsonPlace inner = place.member(found);
    if (found == keys[0]) {
        radius.source = RadiusSource::column;
        radius.column = text_of(by, inner);
    } else if (found == keys[1]) {
        const std::string name = text_of(by, inner);
        if (name != "van-der-waals" && name != "covalent") {
            refuse(inner, "must be van-der-waals or covalent");
        }
        radius.source = name == "covalent" ? RadiusSource::covalent : RadiusSource::van_der_waals;
    } else {
        radius.source = RadiusSource::types;
        radius.types = read_types(by, inner, &read_type_radius);
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

// A colour for all; "type"; {"types": {"H": colour}}; {"columns": [red, green, blue]}; or {"column": name, "map":
// "viridis"}, both with a range.
ParticleColour read_look_colour(const json &value, const JsonPlace &place) {
    ParticleColour colour;
    if (value.is_string()) {
        if (read_text(value, place) != "type") {
            refuse(place, "must be a colour, \"type\", or an object with \"column\", \"columns\" or \"types\"");
        }
        colour.source = ColourSource::type;
        colour.columns = {type_column};
        return colour;
    }
    if (!value.is_object()) {
        colour.source = ColourSource::constant;
        colour.constant = read_colour(value, place);
        return colour;
    }
    const JsonObject object(value, place, {"column", "columns", "types", "map", "range"});
    static constexpr std::array<const char *, 3> keys{"column", "columns", "types"};
    const char *found = only_key(object, keys);
    if (found == nullptr) {
        refuse(place, "must have one of " + any_of(keys));
    }
    const json &by = object.require(found);
    if (found == keys[0]) {
        colour.source = ColourSource::map;
        colour.columns.push_back(text_of(by, place.member(found)));
    } else if (found == keys[1]) {
        read_columns(colour, by, place.member(found));
    } else {
        colour.source = ColourSource::type;
        colour.types = read_types(by, place.member(found), &read_type_colour);
        colour.columns = {column_named_by(colour.types)};
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

} // namespace

ParticleEntry read_particle_entry(const JsonPlace &place, const json &value) {
    const JsonObject object(value, place, {"file", "format", "frame", "wrap", "where", "radius", "color", "material"});
    ParticleEntry entry;
    entry.file = text_of(object.require("file"), place.member("file"));
    entry.query = read_query(object, place);
    if (const json *wrap = object.find("wrap")) {
        entry.wraps = read_truth(*wrap, place.member("wrap"));
    }
    if (const json *radius = object.find("radius")) {
        entry.radius = read_radius(*radius, place.member("radius"));
    }
    entry.has_material = object.find("material") != nullptr;
    if (const json *colour = object.find("color")) {
        entry.colour = read_look_colour(*colour, place.member("color"));
    } else if (entry.has_material) {
        entry.colour.source = ColourSource::constant;
    }
    return entry;
}

void load_particles(SceneFile &scene) {
    const std::vector<std::string> paths = particle_paths(scene);
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        const std::string place = scene.path + ": particles[" + std::to_string(i) + "]";
        ParticleEntry &entry = scene.particles[i];
        try {
            load(entry, paths[i]);
        } catch (const RefusedLook &refused) {
            throw Failure(refused.code(), place + (refused.of_radius ? ".radius: " : ".color: ") + refused.what());
        } catch (const Failure &failure) {
            throw Failure(failure.code(), place + ": " + failure.what());
        }
    }
}

void tell_chosen_ranges(const SceneFile &scene) {
    for (std::size_t i = 0; i < scene.particles.size(); ++i) {
        if (const std::string range = scene.particles[i].chosen_range(); !range.empty()) {
            print_message(scene.path + ": particles[" + std::to_string(i) + "].color: " + range);
        }
    }
}

std::vector<std::string> particle_paths(const SceneFile &scene) {
    const std::filesystem::path folder = std::filesystem::path(scene.path).parent_path();
    std::vector<std::string> paths;
    std::transform(scene.particles.begin(), scene.particles.end(), std::back_inserter(paths),
                   [&folder](const ParticleEntry &entry) { return (folder / entry.file).string(); });
    return paths;
}

} // namespace cli
