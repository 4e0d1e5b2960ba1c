// Planes relative to the camera; see curved_plane.h.
#include "lib/scene/curved_plane.h"

#include <cmath>

namespace pt {

CurvedPlane curved_plane(const Plane &plane, const Material &of_plane, const Camera &camera, std::uint32_t index) {
    const double offset = plane.offset + glm::dot(plane.normal, camera.position);
    return {offset < 0.0 ? -plane.normal : plane.normal,
            std::abs(offset),
            0.0,
            glm::dvec3(0.0),
            plane.material,
            index,
            of_plane.hidden};
}

CurvedPlane curved_plane(const SeenSphere &sphere) {
    return {-sphere.open / sphere.distance,
            sphere.height(),
            1.0 / sphere.radius,
            sphere.way,
            sphere.material,
            sphere.index,
            sphere.hidden};
}

} // namespace pt
