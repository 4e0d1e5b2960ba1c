#include "lib/view/kernel_surfaces.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace pt {

namespace {

// Whether the camera is certainly inside the sphere at all times. Motion is straight, so it suffices to check both
// ends.
bool holds_camera(const SeenSphere &sphere) {
    constexpr double margin = 1.0 - side_margin;
    return sphere.distance < sphere.radius * margin && glm::length(sphere.close()) < sphere.radius * margin;
}

} // namespace

bool lies_apart(const MovingBall &ball, const CurvedPlane &flat) {
    const double open = glm::dot(flat.normal, ball.open) + flat.offset;
    const double close = glm::dot(flat.normal, ball.close()) + flat.offset;
    const double radius = with_margin(ball.radius);
    return std::min(open, close) > radius || std::max(open, close) < -radius;
}

bool lies_apart(const MovingBall &ball, const PointBox &box) {
    const PointBox about = box_about({ball.open, ball.way, with_margin(ball.radius)});
    return glm::any(glm::lessThan(about.high, box.low)) || glm::any(glm::lessThan(box.high, about.low));
}

bool lies_apart(const SeenSphere &hidden, const SeenScene &scene, const SphereTree *tree, const Camera &camera) {
    const MovingBall ball = ball_about(hidden);
    const auto is_in_touch = [&](const auto &surface) { return !surface.hidden && !lies_apart(ball, surface); };
    const auto of_scene = [&](const PointBox &box) {
        return PointBox{box.low - camera.position, box.high - camera.position};
    };
    return !scene.any_surface(is_in_touch) && (tree == nullptr || lies_apart(ball, of_scene(tree->bounds())));
}

KernelSurfaces kernel_surfaces(const SeenScene &distinct, const SphereTree *tree, const Camera &camera) {
    KernelSurfaces surfaces{};
    std::vector<SeenSphere> &spheres = surfaces.spheres;
    spheres.reserve(distinct.spheres.size());
    const auto add = [&](auto &&is_next) {
        const std::size_t before = spheres.size();
        std::ranges::copy_if(distinct.spheres, std::back_inserter(spheres),
                             [&](const SeenSphere &sphere) { return !sphere.is_flat && is_next(sphere); });
        return static_cast<std::uint32_t>(spheres.size() - before);
    };
    const auto is_sky = [&](const SeenSphere &sphere) {
        return holds_camera(sphere) && !(sphere.hidden && lies_apart(sphere, distinct, tree, camera));
    };
    const auto is_lamp = [&](const SeenSphere &sphere) { return sphere.emits && !is_sky(sphere); };
    HiddenCounts &hidden = surfaces.hidden;
    surfaces.lamp_count = add([&](const SeenSphere &sphere) { return is_lamp(sphere) && !sphere.hidden; });
    surfaces.lamp_count += hidden.lamps =
        add([&](const SeenSphere &sphere) { return is_lamp(sphere) && sphere.hidden; });
    surfaces.sky_count = hidden.skies =
        add([&](const SeenSphere &sphere) { return sphere.emits && is_sky(sphere) && sphere.hidden; });
    surfaces.sky_count +=
        add([&](const SeenSphere &sphere) { return sphere.emits && is_sky(sphere) && !sphere.hidden; });
    add([](const SeenSphere &sphere) { return !sphere.emits && !sphere.hidden; });
    hidden.others = add([](const SeenSphere &sphere) { return !sphere.emits && sphere.hidden; });
    for (const SeenSphere &sphere : distinct.spheres)
        if (sphere.is_flat)
            surfaces.planes.push_back(curved_plane(sphere));
    surfaces.planes.insert(surfaces.planes.end(), distinct.planes.begin(), distinct.planes.end());
    const auto seen = std::stable_partition(surfaces.planes.begin(), surfaces.planes.end(),
                                            [](const CurvedPlane &plane) { return plane.hidden; });
    hidden.planes = static_cast<std::uint32_t>(seen - surfaces.planes.begin());
    return surfaces;
}

} // namespace pt
