// The rays of a camera. Each kind of projection has one file (perspective.cpp), and its directions in
// shaders/camera.glsl.
#pragma once

#include "lib/base/rules.h"
#include "lib/scene/camera.h"
#include "lib/scene/moving_ball.h"
#include "lib/scene/scene.h"
#include "lib/tree/sphere_tree.h"
#include "shaders/gpu_layout.h"

#include <pt/pt.h>

#include <cstdint>
#include <limits>
#include <memory>

namespace pt {

struct CurvedPlane;

inline constexpr double out_of_view = std::numeric_limits<double>::infinity();

struct ImagePlace {
    double x; // in pixels from the top left corner
    double y;
    double scale; // pixels per scene unit
    double blur;  // radius in pixels of the disc over which a lens spreads the point
};

// Points and balls are relative to the camera.
class Projection {
public:
    Projection(const Camera &camera, std::uint32_t width, std::uint32_t height) :
        camera_(camera),
        width_(width),
        height_(height) {}
    virtual ~Projection() = default;
    Projection(const Projection &) = delete;
    Projection &operator=(const Projection &) = delete;

    const Camera &camera() const { return camera_; }
    std::uint32_t width() const { return width_; }
    std::uint32_t height() const { return height_; }

    // If the view is so narrow that rounding would be visible, moves the camera ahead to the first surface that may be
    // in view. Rays then start on a plane there, and the plane's center is the origin of the kernel's coordinates.
    // Parallel rays always start on such a plane, in a disc (start_radius). Throws PT_ERROR_UNSUPPORTED if a parallel
    // view is too wide.
    virtual Camera starting_ahead(const Scene &, const SphereTree *) const { return camera_; }

    // The camera must come from starting_ahead().
    gpu::CameraView rays() const;

    virtual bool is_ahead(const glm::dvec3 &center, double radius) const = 0;

    // The point must be ahead.
    virtual ImagePlace place(const glm::dvec3 &point) const = 0;

    // Returns the start of the ray through a point.
    virtual glm::dvec3 origin(const glm::dvec3 &) const { return glm::dvec3(0.0); }

    // Returns a lower bound of a moving ball's depth, or out_of_view.
    virtual double least_depth(const MovingBall &ball) const = 0;

    virtual double pixel_side(double depth) const = 0;

protected:
    virtual void set_rays(gpu::CameraView &view) const = 0;

    // `scale` is in pixels per scene unit. A lens spreads the point over a disc of the radius `spread`.
    ImagePlace place_at(const glm::dvec3 &point, double scale, double spread) const {
        return {0.5 * width_ + scale * glm::dot(point, camera_.right),
                0.5 * height_ - scale * glm::dot(point, camera_.up), scale, scale * spread};
    }

    Camera camera_;
    std::uint32_t width_;
    std::uint32_t height_;
};

// A projection whose rays are inside a cone or cylinder about the direction forward.
class BoundedProjection : public Projection {
public:
    using Projection::Projection;
    bool is_ahead(const glm::dvec3 &center, double radius) const final;
    double least_depth(const MovingBall &ball) const final;

protected:
    // Returns a lower bound of the depth of surfaces, or out_of_view. Rays start so far from tree spheres that float32
    // can decide on which side they start.
    double first_depth(const Scene &scene, const SphereTree *tree) const;

    // The functions below bound the pinhole rays. Lens rays are at most this far from them.
    virtual double aside() const { return 0.0; }
    virtual double depth_of_plane(const CurvedPlane &plane) const = 0;
    virtual double depth_of_ball(const glm::dvec3 &center, double radius) const = 0;
    virtual bool starts_within(const glm::dvec3 &center, double radius) const = 0;
    virtual double depth_from_within(const glm::dvec3 &center, double radius) const = 0;
    // A bound for moving balls that may be better than the depth of the ball around the motion.
    virtual double depth_on_way(const MovingBall &) const { return 0.0; }

private:
    double depth_of_sphere(const MovingBall &sphere, double margin = 0.0) const;
};

template <typename Kind>
std::unique_ptr<Projection> make_projection(const Camera &camera, std::uint32_t width, std::uint32_t height) {
    return std::make_unique<Kind>(camera, width, height);
}

struct ProjectionKind {
    Rule lens_rule; // rule of aperture and focus
    // The fields, position and target have been checked.
    void (*set_view)(Camera &camera, const pt_camera &source, const Subject &subject);
    std::unique_ptr<Projection> (*make)(const Camera &camera, std::uint32_t width, std::uint32_t height);
};

extern const ProjectionKind perspective;
extern const ProjectionKind orthographic;

// Indexed by PT_PROJECTION_*, like view_sizes.
inline constexpr const ProjectionKind *projection_kinds[] = {&perspective, &orthographic};

inline std::unique_ptr<Projection> projection_of(const Camera &camera, std::uint32_t width, std::uint32_t height) {
    return projection_kinds[camera.projection]->make(camera, width, height);
}

} // namespace pt
