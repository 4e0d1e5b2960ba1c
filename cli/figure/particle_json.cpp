#include "cli/figure/particle_json.h"

#include "cli/data/particle_types.h"

#include <nlohmann/json.hpp>

namespace cli {
namespace {

using nlohmann::ordered_json;

ordered_json radius_json(const ParticleRadius &radius) {
    ordered_json json;
    switch (radius.source) {
    case RadiusSource::column:
        json["column"] = radius.column;
        break;
    case RadiusSource::covalent:
    case RadiusSource::van_der_waals:
        json["elements"] = radius.source == RadiusSource::covalent ? "covalent" : "van-der-waals";
        break;
    case RadiusSource::types:
        json["types"] = radius.types;
        break;
    default:
        return radius.scale;
    }
    if (radius.scale != 1.0) {
        json["scale"] = radius.scale;
    }
    return json;
}

ordered_json colour_json(const ParticleColour &colour) {
    switch (colour.source) {
    case ColourSource::type:
        return colour.columns[0] == type_column ? ordered_json("type") : ordered_json{{"column", colour.columns[0]}};
    case ColourSource::components:
        return {{"columns", colour.columns}, {"range", *colour.range}};
    case ColourSource::map: {
        ordered_json json{{"column", colour.columns[0]}, {"map", colour.map}};
        if ((*colour.range)[0] < (*colour.range)[1]) { // else all are alike, which is no range that a file could give
            json["range"] = *colour.range;
        }
        return json;
    }
    default:
        return colour.constant;
    }
}

} // namespace

ordered_json particle_json(const ParticleEntry &entry) {
    ordered_json json{{"file", entry.file}};
    if (entry.query.frame != -1) {
        json["frame"] = entry.query.frame;
    }
    if (entry.wraps) {
        json["wrap"] = true;
    }
    if (!entry.query.where.empty()) {
        json["where"] = entry.query.where;
    }
    json["radius"] = radius_json(entry.shown_radius);
    json["color"] = colour_json(entry.shown_colour);
    return json;
}

} // namespace cli
