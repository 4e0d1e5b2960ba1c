#include "lib/base/error.h"
#include "lib/view/projection.h"
#include "lib/view/seen_scene.h"

#include <algorithm>
#include <cmath>

namespace pt {

namespace {

const char *no_lens_rule(double value) {
    return value == 0.0 ? nullptr : "must be 0 with an orthographic projection, which has no lens";
}

void set_parallel_view(Camera &camera, const pt_camera &source, const Subject &) {
    camera.view_size = source.vertical_extent;
}

// The box of parallel rays, and the cylinder around it.
class Orthographic final : public BoundedProjection {
public:
    Orthographic(const Camera &camera, std::uint32_t width, std::uint32_t height) :
        BoundedProjection(camera, width, height),
        half_right_(0.5 * camera.view_size * width / height * camera.right),
        half_up_(0.5 * camera.view_size * camera.up),
        radius_(std::hypot(glm::length(half_right_), glm::length(half_up_))) {}

    // Rays start before the first surface, by a little more than the view's width, so that no visible surface
    // intersects the disc of starts.
    Camera starting_ahead(const Scene &scene, const SphereTree *tree) const override {
        require_held_view();
        const double depth = first_depth(scene, tree);
        Camera ahead = camera_;
        ahead.start_radius = radius_;
        if (depth < out_of_view)
            ahead.start_distance = std::max(depth - 1.25 * radius_, 0.0);
        ahead.position += ahead.start_distance * camera_.forward;
        return ahead;
    }

    ImagePlace place(const glm::dvec3 &point) const override {
        return place_at(point, height_ / camera_.view_size, 0.0);
    }

    glm::dvec3 origin(const glm::dvec3 &point) const override {
        return point - glm::dot(point, camera_.forward) * camera_.forward;
    }

    double pixel_side(double) const override { return camera_.view_size / height_; }

private:
    void set_rays(gpu::CameraView &view) const override { view.start_scale = static_cast<float>(pixel_side(0.0)); }

    // Squared distances of a wider view would overflow float32.
    void require_held_view() const {
        const double width = camera_.view_size * width_ / height_;
        if (width > max_length)
            refuse_argument("camera", "vertical_extent", number_text(camera_.view_size),
                            "the view's width, vertical_extent times the image's width / height, must be at most 1e18, "
                            "is " +
                                number_text(width),
                            PT_ERROR_UNSUPPORTED);
    }

    // The depth -height / (normal . forward) is least at a corner.
    double depth_of_plane(const CurvedPlane &plane) const override {
        const double across =
            std::abs(glm::dot(plane.normal, half_right_)) + std::abs(glm::dot(plane.normal, half_up_));
        if (plane.offset <= across)
            return 0.0;
        const double slope = -glm::dot(plane.normal, camera_.forward);
        return slope > 0.0 ? (plane.offset - across) / slope : out_of_view;
    }

    // The ray nearest to the ball's center hits the ball first. Let a be the center's depth and c its distance from
    // this ray. The depth is a - sqrt(r^2 - c^2) = (a^2 + c^2 - r^2) / (a + sqrt(r^2 - c^2)). The second form avoids
    // cancellation.
    double depth_of_ball(const glm::dvec3 &center, double radius) const override {
        const double depth = glm::dot(center, camera_.forward);
        const double across = glm::length(center - depth * camera_.forward);
        const double least = std::max(across - radius_, 0.0);
        if (least >= radius)
            return out_of_view;
        const double half_chord = std::sqrt((radius - least) * (radius + least));
        if (depth + half_chord <= 0.0)
            return out_of_view;
        const double distance = glm::length(center);
        const double power = (distance - radius) * (distance + radius) - (across - least) * (across + least);
        return depth > 0.0 && power > 0.0 ? power / (depth + half_chord) : 0.0;
    }

    // Returns the largest distance of a ray from the parallel line through the center.
    double most_across(const glm::dvec3 &center) const {
        return glm::length(center - glm::dot(center, camera_.forward) * camera_.forward) + radius_;
    }

    bool starts_within(const glm::dvec3 &center, double radius) const override {
        return std::hypot(glm::dot(center, camera_.forward), most_across(center)) < radius;
    }

    double depth_from_within(const glm::dvec3 &center, double radius) const override {
        const double most = most_across(center);
        return glm::dot(center, camera_.forward) + std::sqrt((radius - most) * (radius + most));
    }

    // The depth is least at an end of the motion.
    double depth_on_way(const MovingBall &sphere) const override {
        const double open = glm::dot(sphere.open, camera_.forward);
        return open + std::min(glm::dot(sphere.way, camera_.forward), 0.0) - sphere.radius;
    }

    glm::dvec3 half_right_;
    glm::dvec3 half_up_;
    double radius_;
};

} // namespace

const ProjectionKind orthographic = {no_lens_rule, set_parallel_view, make_projection<Orthographic>};

} // namespace pt
