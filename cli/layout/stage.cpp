#include "cli/layout/stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cli {
namespace {

constexpr double one_degree = std::numbers::pi / 180.0;

// A lamp of a given half angle that gives `white` surfaces which face it the radiance `brightness`: their irradiance is
// pi * radiance * sin^2 of the half angle (Lambert), and they give back a pi-th of it.
StageLamp soft_lamp(const glm::dvec3 &direction, double distance, const Bounds &bounds, double half_angle,
                    double brightness) {
    const double sine = std::sin(half_angle);
    return {bounds.center + distance * direction, distance * sine, brightness / (sine * sine)};
}

glm::dvec3 in_view(const ViewFrame &frame, double azimuth, double elevation) {
    const double level = std::cos(elevation);
    return level * std::sin(azimuth) * frame.right - level * std::cos(azimuth) * frame.forward +
           std::sin(elevation) * frame.up;
}

} // namespace

std::optional<FigureStyle> find_figure_style(std::string_view name) {
    const auto found = std::find(figure_style_names.begin(), figure_style_names.end(), name);
    return found == figure_style_names.end()
               ? std::nullopt
               : std::optional(static_cast<FigureStyle>(found - figure_style_names.begin()));
}

Stage make_stage(FigureStyle style, const FittedCamera &camera, const Bounds &bounds,
                 const std::optional<Floor> &floor) {
    // Where a surface faces the key lamp and sees all of the surround, it has the radiance of its albedo: the colours
    // of a legend are those of the lit sides.
    constexpr double surround_brightness = 0.4375; // of few bits, so that means are the same number
    constexpr double key_brightness = 0.75;
    constexpr double key_half_angle =
        14.0 * one_degree; // shadows are as soft as of a window three times as far as wide
    // The lamp is farther than the camera, and so far that the light is nearly as strong at the far end of the data.
    const double far = std::max(20.0 * bounds.radius, 4.0 * camera.target_distance);

    Stage stage{};
    stage.surround = {bounds.center, 10.0 * far, surround_brightness};
    stage.floor = floor;
    stage.floor_albedo = 0.8;
    stage.diffuse = 1.0;
    stage.max_path_length = 4;
    if (style == FigureStyle::ambient_occlusion) {
        stage.surround.emission = 1.0;
        return stage;
    }
    // By eye: the shapes show best, and shadows fall to where there is room for them.
    const glm::dvec3 direction = in_view(camera.frame, -35.0 * one_degree, 40.0 * one_degree);
    stage.key = soft_lamp(direction, far, bounds, key_half_angle, key_brightness);
    if (style == FigureStyle::glossy) {
        stage.specular = 0.12;
        stage.diffuse = 1.0 - stage.specular; // a white ball gives off no more than it receives
        stage.glossiness = 60.0;
    }
    return stage;
}

} // namespace cli
