#include "lib/view/twins.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pt {

namespace {

// Radii of twins differ by at most this fraction, 64 roundings. The error of a distance along a ray is a dozen
// roundings, and paths may be farther from the sphere than the camera is.
constexpr double same_size = 0x1p-18;
// A fraction of the distance: four times the spacing of float32.
constexpr double same_place = 0x1p-21;
// Planes that differ by more than this in direction and distance are distinct. Positions have errors of 2^-22 of the
// distance. So float32 fails to separate distinct planes only in a strip at their intersection or horizon, which is
// narrower than a pixel in the image.
constexpr double two_planes = 0x1p-8;

// (1, sqrt(2), sqrt(3)) / sqrt(6), because spheres on a lattice have different coordinates along this direction.
constexpr glm::dvec3 generic_direction(0.40824829046386307, 0.5773502691896258, 0.7071067811865476);

double tolerance(const SeenSphere &sphere) {
    return std::min(same_size * sphere.radius + same_place * sphere.distance, two_spheres * sphere.radius);
}

// If two curved planes agree within same_size, and the offset is small compared with the radius, centers and radii
// agree within 3 same_size.
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
    return a.kind == b.kind && glm::length(a.open - b.open) <= apart && glm::length(a.close() - b.close()) <= apart &&
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

class Line {
public:
    template <typename Element>
    explicit Line(const std::vector<Element> &elements) {
        for (std::uint32_t index = 0; index < elements.size(); ++index)
            points_.push_back({place_of(elements[index]), index});
        std::ranges::sort(points_, {}, &Point::place);
    }

    std::size_t size() const { return points_.size(); }
    std::uint32_t index(std::size_t i) const { return points_[i].index; }

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

template <typename Element>
void merge_twins(std::vector<Element> &elements) {
    const Line line(elements);
    std::vector<std::size_t> on_line(elements.size());
    for (std::size_t i = 0; i < line.size(); ++i)
        on_line[line.index(i)] = i;
    std::vector<bool> is_twin(elements.size());
    for (std::uint32_t index = 0; index < elements.size(); ++index) {
        const auto is_twin_of = [&](std::uint32_t other) {
            return other < index && !is_twin[other] && are_twins(elements[index], elements[other]);
        };
        is_twin[index] = line.any_near(on_line[index], reach(elements[index]), is_twin_of);
    }
    std::size_t index = 0;
    std::erase_if(elements, [&](const Element &) { return is_twin[index++]; });
}

bool has_close_lamps(const std::vector<SeenSphere> &spheres) {
    const Line line(spheres);
    for (std::size_t i = 0; i < line.size(); ++i) {
        const SeenSphere &lamp = spheres[line.index(i)];
        const auto is_close = [&](std::uint32_t other) { return nearly_coincide(lamp, spheres[other]); };
        // Capsules are sorted by one end, which may be far from the lamp.
        const auto is_in = [&](const SeenSphere &other) {
            return other.kind != Kind::ball && nearly_coincide(lamp, other);
        };
        if (lamp.emits &&
            (line.any_near(i, two_spheres * lamp.radius, is_close) || std::ranges::any_of(spheres, is_in)))
            return true;
    }
    return false;
}

bool has_close_planes(const std::vector<CurvedPlane> &planes) {
    const Line line(planes);
    for (std::size_t i = 0; i < line.size(); ++i) {
        const auto is_close = [&](std::uint32_t other) {
            return are_alike(planes[line.index(i)], planes[other], two_planes);
        };
        if (line.any_near(i, two_planes, is_close))
            return true;
    }
    return false;
}

} // namespace

SeenScene without_twins(SeenScene seen) {
    merge_twins(seen.spheres);
    merge_twins(seen.planes);
    seen.close_lamps = has_close_lamps(seen.spheres);
    seen.close_planes = has_close_planes(seen.planes);
    return seen;
}

} // namespace pt
