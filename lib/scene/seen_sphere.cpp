// Decides which spheres are seen as planes with a curvature; see seen_sphere.h.
#include "lib/scene/seen_sphere.h"

#include <cmath>

namespace pt {

namespace {

// A sphere counts as nearly flat if its radius is this many times its distance from the camera: below, its centre and
// radius cost at most 5 of the 24 bits that a hit near the camera has.
constexpr double nearly_flat = 32.0;

// A lamp held by its centre is sampled by the cone that it subtends; one held as a plane is found by directions alone.
// That is as good where the lamp fills half of the view, but directions rarely hit its rim, so noise rises there.
// Therefore lamps are held by their centres as long as these are precise enough: up to this ratio, where the surface is
// off by 2^-24 R, 1/256 of the distance.
constexpr double nearly_flat_lamp = 65536.0;

bool is_large(const SeenSphere &sphere, double ratio) {
    return sphere.radius > ratio * std::abs(sphere.height());
}

// A moving sphere is seen as if the camera moved the other way, so that its way counts like a distance.
bool moves_little(const SeenSphere &sphere) {
    return sphere.radius > nearly_flat * glm::length(sphere.way);
}

} // namespace

SeenSphere::SeenSphere(const Sphere &sphere, const Material &of_sphere, const Camera &camera, std::uint32_t of_index) :
    MovingBall(seen_ball(sphere.ball(), camera)),
    distance(glm::length(open)),
    material(sphere.material),
    index(of_index),
    emits(pt::emits(of_sphere)),
    hidden(of_sphere.hidden),
    is_flat(!swept && is_large(*this, emits ? nearly_flat_lamp : nearly_flat) && moves_little(*this)) {}

// Held by its centre, a sphere's surface is off by 2^-24 of the radius. Where that is more than 1/256 of its distance,
// the picture would be wrong. Where rays start on a disc, an error that is small beside the disc does no harm.
bool moves_too_far(const SeenSphere &sphere, const Camera &camera) {
    return !sphere.swept && is_large(sphere, nearly_flat_lamp) &&
           sphere.radius > nearly_flat_lamp * camera.start_radius && !moves_little(sphere);
}

} // namespace pt
