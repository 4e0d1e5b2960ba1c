#include "cli/scene/particle_json.h"

#include "cli/data/particle_types.h"

#include <nlohmann/json.hpp>

namespace cli {
namespace {

using nlohmann::ordered_json;

ordered_json radius_json(const ParticleRadius &radius) {
    ordered_json keys;
    switch (radius.source) {
    case RadiusSource::column:
        keys["column"] = radius.column;
        break;
    case RadiusSource::covalent:
    case RadiusSource::van_der_waals:
        keys["elements"] = radius.source == RadiusSource::covalent ? "covalent" : "van-der-waals";
        break;
    case RadiusSource::types:
        keys["types"] = radius.types;
        break;
    default:
        return radius.scale;
    }
    if (radius.scale != 1.0) {
        keys["scale"] = radius.scale;
    }
    return keys;
}

ordered_json colour_json(const ParticleColour &colour) {
    switch (colour.source) {
    case ColourSource::type:
        return colour.columns[0] == type_column ? ordered_json("type") : ordered_json{{"column", colour.columns[0]}};
    case ColourSource::components:
        return {{"columns", colour.columns}, {"range", *colour.range}};
    case ColourSource::map: {
        ordered_json keys{{"column", colour.columns[0]}, {"map", colour.map}};
        if ((*colour.range)[0] < (*colour.range)[1]) { // else all are alike, which is no range that a file could give
            keys["range"] = *colour.range;
        }
        return keys;
    }
    default:
        return colour.constant;
    }
}

} // namespace

ordered_json particle_json(const ParticleEntry &entry) {
    ordered_json keys{{"file", entry.file}};
    if (entry.query.frame != -1) {
        keys["frame"] = entry.query.frame;
    }
    if (entry.wraps) {
        keys["wrap"] = true;
    }
    if (!entry.query.where.empty()) {
        keys["where"] = entry.query.where;
    }
    keys["radius"] = radius_json(entry.shown_radius);
    keys["color"] = colour_json(entry.shown_colour);
    return keys;
}

} // namespace cli
