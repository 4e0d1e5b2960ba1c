#include "cli/import/view_target.h"

#include "cli/import/foreign_vector.h"

#include <algorithm>
#include <limits>

namespace cli {
namespace {

constexpr double infinite_distance = std::numeric_limits<double>::infinity();

double distance_of_spheres(const ForeignScene &scene, const ForeignVector &position, const ForeignVector &direction) {
    ForeignVector low{infinite_distance, infinite_distance, infinite_distance};
    ForeignVector high{-infinite_distance, -infinite_distance, -infinite_distance};
    for (const ForeignSphere &sphere : scene.spheres) {
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], sphere.center[i] - sphere.radius);
            high[i] = std::max(high[i], sphere.center[i] + sphere.radius);
        }
    }
    ForeignVector middle{};
    for (std::size_t i = 0; i < 3; ++i) {
        middle[i] = 0.5 * (low[i] + high[i]);
    }
    return scene.spheres.empty() ? 0.0 : dot(difference(middle, position), direction);
}

double distance_of_planes(const ForeignScene &scene, const ForeignVector &position, const ForeignVector &direction) {
    double nearest = infinite_distance;
    for (const ForeignPlane &plane : scene.planes) {
        const double distance = -(dot(plane.normal, position) + plane.offset) / dot(plane.normal, direction);
        if (distance > 0.0) {
            nearest = std::min(nearest, distance);
        }
    }
    return nearest;
}

} // namespace

ForeignVector view_target(const ForeignScene &scene, const ForeignVector &position, const ForeignVector &direction) {
    const ForeignVector way = unit(direction);
    double distance = distance_of_spheres(scene, position, way);
    if (!(distance > 0.0)) {
        distance = distance_of_planes(scene, position, way);
    }
    return point_at(position, distance < infinite_distance ? distance : 1.0, way);
}

} // namespace cli
