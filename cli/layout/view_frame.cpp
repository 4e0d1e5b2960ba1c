#include "cli/layout/view_frame.h"

#include "cli/base/number.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cli {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::optional<glm::dvec3> parse_vector(std::string_view text) {
    glm::dvec3 vector{};
    for (glm::length_t i = 0; i < vector.length(); ++i) {
        const std::size_t comma = i + 1 < vector.length() ? text.find(',') : text.size();
        const auto number = parse_number<double>(text.substr(0, comma));
        if (!number || comma == std::string_view::npos || !std::isfinite(*number)) {
            return std::nullopt;
        }
        vector[i] = *number;
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return unit_vector(vector);
}

// Of the three-quarter view, above the horizon.
double elevation(double relative_height) {
    constexpr double of_bodies = 22.0 * degree;
    constexpr double of_discs = 50.0 * degree;
    constexpr double of_layers = 90.0 * degree;
    constexpr double body = 0.5; // from this relative height on
    if (relative_height == 0.0) {
        return of_layers;
    }
    return std::lerp(of_discs, of_bodies, std::min(relative_height / body, 1.0));
}

glm::dvec3 toward_camera(const ViewDirection &view, const Compass &compass, double relative_height) {
    constexpr double azimuth = 30.0 * degree;
    const std::string_view name = view.name;
    if (name.empty()) {
        return view.vector;
    }
    if (name == "three-quarter") {
        const double height = elevation(relative_height);
        const glm::dvec3 level = std::cos(azimuth) * compass.front + std::sin(azimuth) * compass.right;
        return height == 90.0 * degree ? compass.up : std::cos(height) * level + std::sin(height) * compass.up;
    }
    const glm::dvec3 &axis = name == "front" || name == "back"   ? compass.front
                             : name == "right" || name == "left" ? compass.right
                                                                 : compass.up;
    return name == "back" || name == "left" || name == "bottom" ? -axis : axis;
}

} // namespace

std::optional<ViewDirection> parse_view(std::string_view text) {
    const auto name = std::find(view_names.begin(), view_names.end(), text);
    if (name != view_names.end()) {
        return ViewDirection{*name, {}};
    }
    const auto vector = parse_vector(text);
    return vector ? std::optional(ViewDirection{{}, *vector}) : std::nullopt;
}

std::optional<glm::dvec3> unit_vector(const glm::dvec3 &vector) {
    // Of any size: squares of what is scaled by the largest do not leave the range of numbers.
    const double largest = std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)});
    return largest == 0.0 ? std::nullopt : std::optional(glm::normalize(vector / largest));
}

std::optional<glm::dvec3> parse_axis(std::string_view text) {
    const bool is_negative = text.starts_with('-');
    const std::string_view axis = text.substr(is_negative ? 1 : 0);
    if (axis.size() == 1 && axis[0] >= 'x' && axis[0] <= 'z') {
        glm::dvec3 up{};
        up[axis[0] - 'x'] = is_negative ? -1.0 : 1.0;
        return up;
    }
    return std::nullopt;
}

std::optional<glm::dvec3> parse_up(std::string_view text) {
    const auto axis = parse_axis(text);
    return axis ? axis : parse_vector(text);
}

Compass compass_of(const glm::dvec3 &up) {
    const bool is_along_x = std::abs(up[0]) > std::max(std::abs(up[1]), std::abs(up[2]));
    const glm::dvec3 axis = is_along_x ? glm::dvec3{0.0, 1.0, 0.0} : glm::dvec3{1.0, 0.0, 0.0};
    const glm::dvec3 right = glm::normalize(axis - glm::dot(axis, up) * up);
    return {right, glm::cross(right, up), up};
}

ViewFrame view_frame(const ViewDirection &view, const glm::dvec3 &up, double relative_height) {
    constexpr double least_sine = 1e-6; // of the angle to up, below which the view is along it
    const Compass compass = compass_of(up);
    const glm::dvec3 toward = toward_camera(view, compass, relative_height);
    const glm::dvec3 forward = -toward;
    const glm::dvec3 across = glm::cross(forward, up);
    // Seen along up, right stays right.
    const glm::dvec3 right = glm::length(across) < least_sine ? compass.right : glm::normalize(across);
    return {right, glm::cross(right, forward), forward};
}

} // namespace cli
