// Finds twins by their places along a line; see twins.h.
#include "lib/scene/twins.h"

#include "lib/scene/curved_plane.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

namespace pt {

namespace {

// Relative differences that count as none: 64 times the rounding of float32, as a distance along a ray is off by a dozen
// roundings of its length, and paths look at a surface from a few times as far away as the camera. Of a sphere's own size.
constexpr double same_size = 0x1p-18;
// Of its distance from the camera: four times the spacing of the numbers that hold its centre.
constexpr double same_place = 0x1p-21;
// Spheres that differ by more than this share of their radii are two, however far away.
constexpr double two_spheres = 0.25;
// Planes that differ by more than this are told apart by any vertex in sight.
constexpr double two_planes = 0x1p-8;

// Spheres on a lattice have different places along a line in this direction, whose components are incommensurable.
const glm::dvec3 generic_direction = glm::normalize(glm::dvec3(1.0, std::sqrt(2.0), std::sqrt(3.0)));

// A sphere as the camera sees it: where its centre is as the shutter opens and closes, and as a plane, if it is held so.
struct SeenSphere {
    glm::dvec3 open;
    glm::dvec3 close;
    double radius;
    std::optional<CurvedPlane> plane;

    SeenSphere(const Sphere &sphere, const Scene &scene, const Camera &camera) :
        open(sphere.center + camera.shutter_open * sphere.motion - camera.position),
        close(sphere.center + camera.shutter_close * sphere.motion - camera.position),
        radius(sphere.radius),
        plane(curved_plane(sphere, scene.materials[sphere.material], camera)) {}

    double place() const { return glm::dot(open, generic_direction); }

    // By how much the centre of a twin may be elsewhere.
    double tolerance() const {
        return std::min(same_size * radius + same_place * glm::length(open), two_spheres * radius);
    }

    // The same, if it may be held as a plane. Planes that agree to same_size in normal, offset and curvature
    // have centres and radii that agree to three times that, where the offset is small against the radius.
    double reach() const { return plane ? 4.0 * same_size * radius : tolerance(); }
};

// The largest distance of a point of one sphere from the other.
double difference(const SeenSphere &a, const SeenSphere &b) {
    return std::max(glm::length(a.open - b.open), glm::length(a.close - b.close)) + std::abs(a.radius - b.radius);
}

bool are_alike(const CurvedPlane &a, const CurvedPlane &b, double tolerance) {
    const double offset = std::max(std::abs(a.offset), std::abs(b.offset));
    const double curvature = std::max(a.curvature, b.curvature);
    return glm::length(a.normal - b.normal) <= tolerance && std::abs(a.offset - b.offset) <= tolerance * offset &&
           std::abs(a.curvature - b.curvature) <= tolerance * curvature &&
           glm::length(a.way - b.way) <= tolerance * offset;
}

bool are_twins(const SeenSphere &a, const SeenSphere &b) {
    if (a.plane && b.plane)
        return are_alike(*a.plane, *b.plane, same_size);
    const double tolerance = std::min(a.tolerance(), b.tolerance());
    return glm::length(a.open - b.open) <= tolerance && glm::length(a.close - b.close) <= tolerance &&
           std::abs(a.radius - b.radius) <= same_size * std::min(a.radius, b.radius);
}

// Elements by a number, which those alike have nearly alike.
template <typename Element>
class Line {
public:
    void add(double place, Element element) { elements_.emplace(place, std::move(element)); }

    // Whether one within reach of a place has a property.
    template <typename Property>
    bool any(double place, double reach, Property &&property) const {
        const auto end = elements_.upper_bound(place + reach);
        return std::any_of(elements_.lower_bound(place - reach), end,
                           [&](const auto &entry) { return property(entry.second); });
    }

private:
    std::multimap<double, Element> elements_;
};

std::vector<Sphere> distinct_spheres(const Scene &scene, const Camera &camera) {
    std::vector<Sphere> distinct;
    Line<SeenSphere> line;
    for (const Sphere &sphere : scene.spheres) {
        const SeenSphere seen(sphere, scene, camera);
        if (line.any(seen.place(), seen.reach(), [&](const SeenSphere &other) { return are_twins(seen, other); }))
            continue;
        line.add(seen.place(), seen);
        distinct.push_back(sphere);
    }
    return distinct;
}

std::vector<Plane> distinct_planes(const Scene &scene, const Camera &camera) {
    std::vector<Plane> distinct;
    Line<CurvedPlane> line;
    for (const Plane &plane : scene.planes) {
        const CurvedPlane seen = curved_plane(plane, camera);
        const double place = glm::dot(seen.normal, generic_direction);
        if (line.any(place, same_size, [&](const CurvedPlane &other) { return are_alike(seen, other, same_size); }))
            continue;
        line.add(place, seen);
        distinct.push_back(plane);
    }
    return distinct;
}

} // namespace

Scene without_twins(const Scene &scene, const Camera &camera) {
    return {scene.materials, distinct_spheres(scene, camera), distinct_planes(scene, camera)};
}

bool has_close_lamps(const Scene &scene, const Camera &camera) {
    Line<const SeenSphere *> line;
    std::vector<SeenSphere> spheres;
    spheres.reserve(scene.spheres.size());
    for (const Sphere &sphere : scene.spheres) {
        spheres.emplace_back(sphere, scene, camera);
        line.add(spheres.back().place(), &spheres.back());
    }
    const auto is_close_lamp = [&](const SeenSphere &lamp) {
        return line.any(lamp.place(), two_spheres * lamp.radius, [&](const SeenSphere *other) {
            return other != &lamp && difference(lamp, *other) < two_spheres * std::min(lamp.radius, other->radius);
        });
    };
    for (std::size_t i = 0; i < spheres.size(); ++i)
        if (scene.materials[scene.spheres[i].material].emission != glm::vec3(0.0F) && is_close_lamp(spheres[i]))
            return true;
    return false;
}

bool has_close_planes(const Scene &scene, const Camera &camera) {
    Line<CurvedPlane> line;
    for (const Plane &plane : scene.planes) {
        const CurvedPlane seen = curved_plane(plane, camera);
        const double place = glm::dot(seen.normal, generic_direction);
        if (line.any(place, two_planes, [&](const CurvedPlane &other) { return are_alike(seen, other, two_planes); }))
            return true;
        line.add(place, seen);
    }
    return false;
}

} // namespace pt
