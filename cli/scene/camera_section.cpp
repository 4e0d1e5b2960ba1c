#include "cli/scene/camera_section.h"

#include "cli/base/store.h"
#include "cli/base/suggestion.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <string_view>

namespace cli {

using nlohmann::json;

CameraSection::CameraSection(pt_camera &camera) : camera_(camera) {
    camera_ = {};
    camera_.struct_size = sizeof(pt_camera);
    camera_.position[2] = 1.0;
}

void CameraSection::item(const JsonPlace &place, const json &value) {
    static constexpr std::array<std::string_view, 7> known{"position",     "look_at",         "up",     "projection",
                                                           "vertical_fov", "vertical_extent", "shutter"};
    if (place.key == "position") {
        store(read_vector(value, place), camera_.position);
        has_position_ = true;
    } else if (place.key == "look_at") {
        store(read_vector(value, place), camera_.target);
        has_look_at_ = true;
    } else if (place.key == "up") {
        const auto up = read_vector(value, place);
        if (up == std::array{0.0, 0.0, 0.0})
            refuse(place, "must not be [0, 0, 0]"); // pt.h takes it as "default"
        store(up, camera_.up);
    } else if (place.key == "vertical_fov") {
        const double degrees = read_number(value, place);
        // The library's rule, [1e-8, pi), in the file's unit; 0 would be pt.h's default.
        if (!(degrees >= 6e-7 && degrees < 180.0))
            refuse(place, "must be at least 6e-7 and less than 180 degrees, is " + value.dump());
        camera_.vertical_fov = degrees * (std::numbers::pi / 180.0);
    } else if (place.key == "projection") {
        const std::string_view name = read_text(value, place);
        if (std::ranges::find(projection_names, name) == projection_names.end())
            refuse(place, unknown_name("projection", name, projection_names));
        camera_.projection = name == "orthographic" ? PT_PROJECTION_ORTHOGRAPHIC : PT_PROJECTION_PERSPECTIVE;
    } else if (place.key == "vertical_extent") {
        camera_.vertical_extent = read_number(value, place);
        if (!(camera_.vertical_extent > 0.0))
            refuse(place, "must be > 0, is " + value.dump());
    } else if (place.key == "shutter") {
        const auto [open, close] = read_pair(value, place);
        camera_.shutter_open = open;
        // pt.h takes [0, 0] as its default, the whole of [0, 1]. Here it is the instant 0, and the smallest number
        // after 0 makes an interval in which nothing moves.
        camera_.shutter_close = open == 0.0 && close == 0.0 ? std::numeric_limits<double>::denorm_min() : close;
    } else {
        refuse_unknown_key(*place.parent, place.key, known);
    }
}

void CameraSection::require_complete() const {
    const JsonPlace root;
    if (is_there_ && !has_position_)
        refuse(root.member("camera"), "\"position\" is missing");
    if (is_there_ && !has_look_at_)
        refuse(root.member("camera"), "\"look_at\" is missing");
    const bool orthographic = camera_.projection == PT_PROJECTION_ORTHOGRAPHIC;
    if (orthographic && camera_.vertical_fov != 0.0) {
        refuse(root.member("camera"), "\"vertical_fov\" is of a perspective projection, an orthographic one has a "
                                      "\"vertical_extent\"");
    }
    if (orthographic && camera_.vertical_extent == 0.0)
        refuse(root.member("camera"), "\"vertical_extent\" is missing, the height of an orthographic view");
    if (!orthographic && camera_.vertical_extent != 0.0) {
        refuse(root.member("camera"), "\"vertical_extent\" is of an orthographic projection, a perspective one has a "
                                      "\"vertical_fov\"");
    }
}

} // namespace cli
