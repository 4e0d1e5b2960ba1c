#include "cli/scene/scene_reader.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace cli {

using nlohmann::json;

void SceneReader::begin_section(const JsonPlace &place, json::value_t kind) {
    struct Section {
        std::string_view name;
        json::value_t kind;
        ItemReader read_item;
    };
    static constexpr std::array<Section, 7> sections{{
        {"camera", json::value_t::object, &SceneReader::camera_item},
        {"film", json::value_t::object, &SceneReader::film_item},
        {"render", json::value_t::object, &SceneReader::render_item},
        {"materials", json::value_t::object, &SceneReader::material_item},
        {"spheres", json::value_t::array, &SceneReader::sphere_item},
        {"planes", json::value_t::array, &SceneReader::plane_item},
        {"animation", json::value_t::object, &SceneReader::animation_item},
    }};
    const auto section = std::find_if(sections.begin(), sections.end(),
                                      [&](const Section &candidate) { return candidate.name == place.key; });
    if (place.key == "particles" || place.key == "figure") {
        refuse(place,
               "is no longer read: `pt figure DATA --write-scene SCENE` writes a scene whose spheres have columns, "
               "{\"center\": \"a.npy\", ...}");
    }
    if (section == sections.end()) {
        std::array<std::string_view, sections.size()> known;
        std::transform(sections.begin(), sections.end(), known.begin(), [](const Section &each) { return each.name; });
        refuse_unknown_key(*place.parent, place.key, known);
    }
    if (kind != section->kind)
        refuse(place, "must be " + json_kind(section->kind) + ", is " + json_kind(kind));
    read_item_ = section->read_item;
    if (place.key == "camera")
        camera_.begin();
}

void SceneReader::finish() {
    camera_.require_complete();
    surfaces_.resolve_materials();
}

} // namespace cli
