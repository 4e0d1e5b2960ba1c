// Finds twins by their places along a line; see twins.h.
#include "lib/scene/twins.h"

#include "lib/scene/curved_plane.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace pt {

namespace {

// Relative to a sphere's own size, differences up to this count as none. It is 64 times the rounding of float32: a
// distance along a ray is off by a dozen roundings of its length, and paths look at a surface from a few times as far
// away as the camera.
constexpr double same_size = 0x1p-18;
// The same relative to the distance from the camera: four times the spacing of the numbers that hold the centre.
constexpr double same_place = 0x1p-21;
// Planes that differ by more than this share are told apart by their vertices, whose places are known to 2^-22 of their
// distance. Planes at this angle to each other are nearer than that in a band of 2^-22 / 2^-8 = 2^-14 of the distance
// about the line where they meet; parallel ones, this share of the camera's height above them apart, from 2^14 heights
// on, which is a strip of 2^-14 below the horizon. Either is less than a pixel of an image that is a right angle wide
// in 2^14 pixels.
constexpr double two_planes = 0x1p-8;

// Spheres on a lattice have different places along a line in this direction, whose components are incommensurable: 1,
// the roots of 2 and 3, over that of 6.
constexpr glm::dvec3 generic_direction(0.40824829046386307, 0.5773502691896258, 0.7071067811865476);

// How far the centre of a twin may be away.
double tolerance(const SeenSphere &sphere) {
    return std::min(same_size * sphere.radius + same_place * sphere.distance, two_spheres * sphere.radius);
}

// The same, if it may be held as a plane. Planes that agree to same_size in normal, offset and curvature have centres
// and radii that agree to three times that, where the offset is small against the radius.
double reach(const SeenSphere &sphere) {
    return sphere.is_flat ? 4.0 * same_size * sphere.radius : tolerance(sphere);
}

bool are_alike(const CurvedPlane &a, const CurvedPlane &b, double tolerance) {
    const double offset = std::max(std::abs(a.offset), std::abs(b.offset));
    const double curvature = std::max(a.curvature, b.curvature);
    return glm::length(a.normal - b.normal) <= tolerance && std::abs(a.offset - b.offset) <= tolerance * offset &&
           std::abs(a.curvature - b.curvature) <= tolerance * curvature &&
           glm::length(a.way - b.way) <= tolerance * offset;
}

bool are_twins(const SeenSphere &a, const SeenSphere &b) {
    if (a.is_flat && b.is_flat)
        return are_alike(curved_plane(a), curved_plane(b), same_size);
    const double apart = std::min(tolerance(a), tolerance(b));
    return a.swept == b.swept && glm::length(a.open - b.open) <= apart && glm::length(a.close() - b.close()) <= apart &&
           std::abs(a.radius - b.radius) <= same_size * std::min(a.radius, b.radius);
}

bool are_twins(const CurvedPlane &a, const CurvedPlane &b) {
    return are_alike(a, b, same_size);
}

double place_of(const SeenSphere &sphere) {
    return glm::dot(sphere.open, generic_direction);
}

double place_of(const CurvedPlane &plane) {
    return glm::dot(plane.normal, generic_direction);
}

double reach(const CurvedPlane &) {
    return same_size;
}

// Indices of elements, sorted by their positions on a line, which are nearly equal for similar elements.
class Line {
public:
    // Sorts the indices from any order; nearly sorted ones are fastest.
    template <typename Element>
    Line(const std::vector<Element> &elements, const std::vector<std::uint32_t> &order) {
        points_.reserve(order.size());
        for (const std::uint32_t index : order)
            points_.push_back({place_of(elements[index]), index});
        if (!std::ranges::is_sorted(points_, {}, &Point::place))
            std::ranges::sort(points_, {}, &Point::place);
    }

    std::size_t size() const { return points_.size(); }
    std::uint32_t index(std::size_t i) const { return points_[i].index; }

    // Whether some other element within reach of the i-th one has a property.
    template <typename Property>
    bool any_near(std::size_t i, double reach, Property &&property) const {
        for (std::size_t k = i; k > 0 && points_[i].place - points_[k - 1].place <= reach; --k)
            if (property(points_[k - 1].index))
                return true;
        for (std::size_t k = i + 1; k < size() && points_[k].place - points_[i].place <= reach; ++k)
            if (property(points_[k].index))
                return true;
        return false;
    }

private:
    struct Point {
        double place;
        std::uint32_t index;
    };
    std::vector<Point> points_;
};

// Marks the elements that are twins of an earlier one that is not itself a twin. Few elements have another within
// reach.
template <typename Element>
std::vector<bool> twins_of_earlier(const std::vector<Element> &elements, const Line &line) {
    std::vector<std::pair<std::uint32_t, std::size_t>> crowded; // their indices, and where on the line they are
    for (std::size_t i = 0; i < line.size(); ++i)
        if (line.any_near(i, reach(elements[line.index(i)]), [](std::uint32_t) { return true; }))
            crowded.emplace_back(line.index(i), i);
    std::ranges::sort(crowded);
    std::vector<bool> is_twin(elements.size());
    for (const auto &[index, i] : crowded) {
        const Element &element = elements[index];
        const auto is_twin_of = [&, own_index = index](std::uint32_t other) {
            return other < own_index && !is_twin[other] && are_twins(element, elements[other]);
        };
        is_twin[index] = line.any_near(i, reach(element), is_twin_of);
    }
    return is_twin;
}

bool has_close_lamps(const std::vector<SeenSphere> &spheres, const Line &line, const std::vector<bool> &is_twin) {
    for (std::size_t i = 0; i < line.size(); ++i) {
        const SeenSphere &lamp = spheres[line.index(i)];
        const auto is_close = [&](std::uint32_t other) {
            return !is_twin[other] && nearly_coincide(lamp, spheres[other]);
        };
        // A capsule is on the line where it begins, however far from there it comes near the lamp.
        const auto is_in = [&](const SeenSphere &other) { return other.swept && nearly_coincide(lamp, other); };
        if (lamp.emits && !is_twin[line.index(i)] &&
            (line.any_near(i, two_spheres * lamp.radius, is_close) || std::ranges::any_of(spheres, is_in)))
            return true;
    }
    return false;
}

bool has_close_planes(const std::vector<CurvedPlane> &planes, const Line &line, const std::vector<bool> &is_twin) {
    for (std::size_t i = 0; i < line.size(); ++i) {
        const std::uint32_t plane = line.index(i);
        const auto is_close = [&](std::uint32_t other) {
            return !is_twin[other] && are_alike(planes[plane], planes[other], two_planes);
        };
        if (!is_twin[plane] && line.any_near(i, two_planes, is_close))
            return true;
    }
    return false;
}

template <typename Element>
void erase(std::vector<Element> &elements, const std::vector<bool> &is_twin) {
    std::size_t index = 0;
    std::erase_if(elements, [&](const Element &) { return is_twin[index++]; });
}

std::vector<std::uint32_t> order_of_array(std::size_t size) {
    std::vector<std::uint32_t> order(size);
    std::iota(order.begin(), order.end(), 0U);
    return order;
}

} // namespace

std::vector<std::uint32_t> order_along_line(const std::vector<Sphere> &spheres) {
    std::vector<double> places;
    places.reserve(spheres.size());
    for (const Sphere &sphere : spheres)
        places.push_back(glm::dot(sphere.center, generic_direction));
    std::vector<std::uint32_t> order = order_of_array(spheres.size());
    std::ranges::sort(order, {}, [&](std::uint32_t index) { return places[index]; });
    return order;
}

DistinctScene without_twins(SeenScene seen, const std::vector<std::uint32_t> &order) {
    DistinctScene distinct{std::move(seen), false, false};
    std::vector<SeenSphere> &spheres = distinct.seen.spheres;
    const Line sphere_line(spheres, order);
    const std::vector<bool> sphere_twins = twins_of_earlier(spheres, sphere_line);
    distinct.close_lamps = has_close_lamps(spheres, sphere_line, sphere_twins);
    erase(spheres, sphere_twins);

    std::vector<CurvedPlane> &planes = distinct.seen.planes;
    const Line plane_line(planes, order_of_array(planes.size()));
    const std::vector<bool> plane_twins = twins_of_earlier(planes, plane_line);
    distinct.close_planes = has_close_planes(planes, plane_line, plane_twins);
    erase(planes, plane_twins);
    return distinct;
}

} // namespace pt
