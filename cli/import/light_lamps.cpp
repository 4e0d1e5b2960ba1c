#include "cli/import/light_lamps.h"

#include "cli/import/foreign_vector.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace cli {
namespace {

constexpr double default_radius = 1.0 / 50.0; // of the distance
constexpr double least_radius = 1e-6;         // likewise: what is smaller lies on a surface
constexpr double sun_distance = 100.0;        // of the size of the scene

// From the point to the nearest surface.
double clearance(const ForeignScene &scene, const ForeignVector &point) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const ForeignSphere &sphere : scene.spheres) {
        nearest = std::min(nearest, std::abs(length(difference(point, sphere.center)) - sphere.radius));
    }
    for (const ForeignPlane &plane : scene.planes) {
        nearest = std::min(nearest, std::abs(dot(plane.normal, point) + plane.offset) / length(plane.normal));
    }
    return nearest;
}

// A Lambert ball of radius r and radiance L lights what faces it at the distance d by pi L (r / d)^2, of which a white
// surface makes the radiance L (r / d)^2.
std::optional<ForeignLamp> lamp_at(const ForeignScene &scene, const ForeignLight &light, const ForeignVector &center,
                                   double distance) {
    const bool is_seen = light.radius > 0.0;
    double room = clearance(scene, center);
    if (is_seen) {
        room = std::min(room, length(difference(center, scene.camera.position)));
    }
    const double radius = std::min(is_seen ? light.radius : default_radius * distance, 0.5 * room);
    if (!(radius >= least_radius * distance)) {
        return std::nullopt;
    }
    const double faded = light.attenuation[0] + distance * (light.attenuation[1] + distance * light.attenuation[2]);
    const double brightness = (distance / radius) * (distance / radius) / faded;
    return ForeignLamp{center,
                       radius,
                       {brightness * light.color[0], brightness * light.color[1], brightness * light.color[2]},
                       !is_seen};
}

std::optional<ForeignLamp> lamp_of(const ForeignScene &scene, const ForeignLight &light, double extent) {
    const ForeignVector &target = scene.camera.look_at;
    if (light.is_directional) {
        const double distance = sun_distance * extent;
        return lamp_at(scene, light, point_at(target, distance, unit(light.place)), distance);
    }
    // A light at the point that is looked at is measured at the camera.
    const double from_target = length(difference(light.place, target));
    const double distance =
        from_target > least_radius * extent ? from_target : length(difference(light.place, scene.camera.position));
    return lamp_at(scene, light, light.place, distance);
}

} // namespace

double extent_of(const ForeignScene &scene) {
    const ForeignVector &target = scene.camera.look_at;
    double extent = length(difference(scene.camera.position, target));
    for (const ForeignSphere &sphere : scene.spheres) {
        extent = std::max(extent, length(difference(sphere.center, target)) + sphere.radius);
    }
    for (const ForeignLight &light : scene.lights) {
        if (!light.is_directional) {
            extent = std::max(extent, length(difference(light.place, target)));
        }
    }
    return extent;
}

std::vector<ForeignLamp> lamps_of(const ForeignScene &scene, std::vector<std::string> &left_out) {
    const double extent = extent_of(scene);
    std::vector<ForeignLamp> lamps;
    for (const ForeignLight &light : scene.lights) {
        if (light.color == ForeignVector{}) {
            continue;
        }
        if (const auto lamp = lamp_of(scene, light, extent)) {
            lamps.push_back(*lamp);
        } else {
            left_out.push_back(light.file_place + ": the light lies on a surface, and is left out");
        }
    }
    return lamps;
}

} // namespace cli
