#include "cli/scene/figure_section.h"

#include "cli/base/suggestion.h"
#include "cli/scene/camera_section.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>

namespace cli {
namespace {

using nlohmann::json;

glm::dvec3 read_direction(const json &value, const JsonPlace &place) {
    const auto direction = unit_vector(glm::make_vec3(read_vector(value, place).data()));
    if (!direction) {
        refuse(place, "must not be [0, 0, 0]");
    }
    return *direction;
}

template <std::size_t Count>
std::string_view read_known_name(const json &value, const JsonPlace &place, const std::string &kind,
                                 const std::array<std::string_view, Count> &known) {
    const std::string_view name = read_text(value, place);
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
        refuse(place, unknown_name(kind, name, known));
    }
    return *found;
}

} // namespace

void read_figure_item(FigureLook &look, const JsonPlace &place, const json &value) {
    static constexpr std::array<std::string_view, 5> known{"view", "up", "projection", "style", "floor"};
    if (place.key == "view") {
        look.view = value.is_string() ? ViewDirection{read_known_name(value, place, "view", view_names), {}}
                                      : ViewDirection{{}, read_direction(value, place)};
    } else if (place.key == "up") {
        const auto axis = value.is_string() ? parse_axis(read_text(value, place)) : read_direction(value, place);
        if (!axis) {
            refuse(place, "must be x, y or z, with or without a minus sign, or [x, y, z], is " + value.dump());
        }
        look.up = *axis;
    } else if (place.key == "projection") {
        const std::string_view name = read_known_name(value, place, "projection", projection_names);
        look.projection = name == "orthographic" ? Projection::orthographic : Projection::perspective;
    } else if (place.key == "style") {
        look.style = *find_figure_style(read_known_name(value, place, "style", figure_style_names));
    } else if (place.key == "floor") {
        look.has_floor = read_truth(value, place);
    } else {
        refuse_unknown_key(*place.parent, place.key, known);
    }
}

} // namespace cli
