#include "lib/base/scaled_vector.h"
#include "lib/view/projection.h"
#include "lib/view/seen_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pt {

namespace {

// In narrower pixels, the error of directions, 2^-24, exceeds 1/1024 of a pixel.
constexpr double narrow_pixel = 0x1p-14; // side of a pixel at distance 1

const char *lens_rule(double value) {
    return value < 0.0 ? "must be >= 0" : length_rule(value);
}

// Systems' tangents differ in the last bits, but films must match, so the tangent is rounded to 40 bits.
double tangent(double angle) {
    int exponent = 0;
    const double mantissa = std::frexp(std::tan(angle), &exponent);
    return std::ldexp(std::nearbyint(std::ldexp(mantissa, 40)), exponent - 40);
}

// A far point's blur is radius / focus times the image plane's distance. For focus >= radius this is at most the
// plane's distance.
void set_perspective_view(Camera &camera, const pt_camera &source, const Subject &subject) {
    const double focus = source.focus > 0.0 ? source.focus : glm::distance(vector(source.target), camera.position);
    subject.require(source.aperture <= 2.0 * focus, "aperture", source.aperture,
                    "must be at most twice the focus (" + number_text(focus) + ")");
    camera.view_size = tangent(0.5 * source.vertical_fov);
    camera.lens_radius = 0.5 * source.aperture;
    camera.focus = source.aperture > 0.0 ? focus : 0.0;
}

// The pyramid of rays through the center of the lens, and the cone around it.
class Perspective final : public BoundedProjection {
public:
    Perspective(const Camera &camera, std::uint32_t width, std::uint32_t height) :
        BoundedProjection(camera, width, height) {
        const double up = camera.view_size;
        const double right = up * width / height;
        half_angle_ = std::atan(std::hypot(up, right));
        corners_ = {camera.forward - right * camera.right - up * camera.up,
                    camera.forward + right * camera.right - up * camera.up,
                    camera.forward - right * camera.right + up * camera.up,
                    camera.forward + right * camera.right + up * camera.up};
    }

    Camera starting_ahead(const Scene &scene, const SphereTree *tree) const override {
        Camera ahead = camera_;
        ahead.start_radius = camera_.lens_radius;
        if (pixel_side(1.0) > narrow_pixel)
            return ahead;
        const double depth = first_depth(scene, tree);
        if (depth == out_of_view)
            return ahead;
        // Rays start in front of the first surface, at a distance of the lens's radius and half the view's width.
        // Rounding then puts no start behind the surface. A lens's rays must start before the focus.
        const double tangent = std::tan(half_angle_);
        ahead.start_distance = std::max((1.0 - tangent) * depth - camera_.lens_radius, 0.0);
        if (camera_.has_lens()) {
            ahead.start_distance = std::min(ahead.start_distance, camera_.focus);
            ahead.start_radius = tangent * ahead.start_distance + camera_.spread(ahead.start_distance);
        }
        ahead.position += ahead.start_distance * camera_.forward;
        return ahead;
    }

    ImagePlace place(const glm::dvec3 &point) const override {
        const double depth = glm::dot(point, camera_.forward);
        return place_at(point, 0.5 * height_ / (depth * camera_.view_size), camera_.spread(depth));
    }

    double pixel_side(double depth) const override { return depth * (2.0 * camera_.view_size / height_); }

private:
    void set_rays(gpu::CameraView &view) const override {
        const double image_distance = height_ / (2.0 * camera_.view_size);
        view.forward = camera_.forward * image_distance;
        if (camera_.has_lens()) {
            view.lens_radius = static_cast<float>(camera_.spread(camera_.start_distance));
            view.lens_blur = static_cast<float>(camera_.lens_radius / camera_.focus * image_distance);
        }
        view.start_scale = static_cast<float>(pixel_side(camera_.start_distance));
    }

    double aside() const override { return camera_.lens_radius; }

    // The depth -offset / (normal . direction) is least at a corner.
    double depth_of_plane(const CurvedPlane &plane) const override {
        const double offset = std::max(plane.offset - aside(), 0.0);
        double nearest = offset == 0.0 ? 0.0 : out_of_view;
        for (const glm::dvec3 &corner : corners_) {
            const double depth = -offset / glm::dot(plane.normal, corner);
            nearest = depth > 0.0 ? std::min(nearest, depth) : nearest;
        }
        return nearest;
    }

    double angle_from_middle(const glm::dvec3 &point) const {
        const double along = glm::dot(point, camera_.forward);
        return std::atan2(glm::length(point - along * camera_.forward), along);
    }

    // The cone's direction nearest to the center hits the ball first. With b = d cos(angle), the distance is b -
    // sqrt(r^2 - d^2 sin^2(angle)) = (d^2 - r^2) / (b + sqrt(r^2 - d^2 sin^2(angle))). The second form avoids
    // cancellation.
    double depth_of_ball(const glm::dvec3 &center, double radius) const override {
        const double distance = glm::length(center);
        const double power = (distance - radius) * (distance + radius);
        if (power <= 0.0)
            return 0.0;
        const double angle = angle_from_middle(center);
        const double nearest = std::max(angle - half_angle_, 0.0);
        const double across = distance * std::sin(nearest);
        const double squared_half_chord = radius * radius - across * across;
        const double b = distance * std::cos(nearest);
        if (b <= 0.0 || squared_half_chord < 0.0)
            return out_of_view;
        return power / (b + std::sqrt(squared_half_chord)) * std::cos(half_angle_);
    }

    bool starts_within(const glm::dvec3 &center, double radius) const override { return glm::length(center) <= radius; }

    // If rays start inside, the direction farthest from the center hits the sphere first.
    double depth_from_within(const glm::dvec3 &center, double radius) const override {
        const double distance = glm::length(center);
        const double angle = angle_from_middle(center);
        const double farthest = std::min(angle + half_angle_, std::numbers::pi);
        const double across = distance * std::sin(farthest);
        const double half_chord = std::sqrt(radius * radius - across * across);
        return (distance * std::cos(farthest) + half_chord) * std::cos(half_angle_);
    }

    std::array<glm::dvec3, 4> corners_; // directions, scaled to 1 along `forward`
    double half_angle_;
};

} // namespace

const ProjectionKind perspective = {lens_rule, set_perspective_view, make_projection<Perspective>};

} // namespace pt
