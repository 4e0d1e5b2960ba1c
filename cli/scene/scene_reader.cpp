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
    static constexpr std::array<Section, 9> sections{{
        {"camera", json::value_t::object, &SceneReader::camera_item},
        {"figure", json::value_t::object, &SceneReader::figure_item},
        {"film", json::value_t::object, &SceneReader::film_item},
        {"render", json::value_t::object, &SceneReader::render_item},
        {"materials", json::value_t::object, &SceneReader::material_item},
        {"spheres", json::value_t::array, &SceneReader::sphere_item},
        {"particles", json::value_t::array, &SceneReader::particle_item},
        {"planes", json::value_t::array, &SceneReader::plane_item},
        {"animation", json::value_t::object, &SceneReader::animation_item},
    }};
    const auto section = std::find_if(sections.begin(), sections.end(),
                                      [&](const Section &candidate) { return candidate.name == place.key; });
    if (section == sections.end()) {
        std::array<std::string_view, sections.size()> known;
        std::transform(sections.begin(), sections.end(), known.begin(), [](const Section &each) { return each.name; });
        refuse_unknown_key(*place.parent, place.key, known);
    }
    if (kind != section->kind) {
        refuse(place, "must be " + json_kind(section->kind) + ", is " + json_kind(kind));
    }
    read_item_ = section->read_item;
    if (place.key == "camera") {
        camera_.begin();
    } else if (place.key == "figure" && !scene_.figure) {
        scene_.figure.emplace();
    }
}

void SceneReader::finish() {
    camera_.require_complete();
    surfaces_.resolve_materials();
    const JsonPlace root;
    if (scene_.figure && camera_.is_there()) {
        refuse(root.member("camera"),
               "a scene has either a camera or a figure, whose camera follows from its particles");
    }
    if (scene_.figure && scene_.particles.empty()) {
        refuse(root.member("figure"), "the scene has no particles, from which its camera could follow");
    }
    const auto bare = std::find_if(scene_.particles.begin(), scene_.particles.end(),
                                   [](const ParticleEntry &entry) { return !entry.has_material; });
    if (!scene_.figure && bare != scene_.particles.end()) {
        const JsonPlace particles = root.member("particles");
        refuse(particles.element(static_cast<std::size_t>(bare - scene_.particles.begin())),
               "\"material\" is missing, which only particles of a figure may lack");
    }
}

} // namespace cli
