#include "lib/scene/camera.h"

#include "lib/base/digest.h"
#include "lib/base/rules.h"
#include "lib/base/scaled_vector.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace pt {

namespace {

constexpr double default_vertical_fov = std::numbers::pi / 4.0;

// The least sine s of the angle between `up` and the view. With u = 2^-53, errors are 2 u in forward, u in up and 2 u
// in their cross product, together 5 u / s in the unit vectors. For s >= 5 * 2^-29 this is below float32's rounding,
// 2^-24.
constexpr double min_sine = 0x1p-26;

// The image plane's distance in pixels, height / (2 tan(fov / 2)), must be at most 1e18, so tan(fov / 2) >= 2^31 / 1e18
// = 2.1e-9.
constexpr double min_vertical_fov = 1e-8;

const char *fov_rule(double value) {
    if (!std::isfinite(value))
        return "must be finite";
    return value >= min_vertical_fov && value < std::numbers::pi ? nullptr : "must lie in [1e-8, pi)";
}

const char *lens_rule(double value) {
    return value < 0.0 ? "must be >= 0" : length_rule(value);
}

const char *shutter_rule(double value) {
    if (!std::isfinite(value))
        return "must be finite";
    if (value < 0.0)
        return "must be >= 0";
    return value <= 1.0 ? nullptr : "must be <= 1";
}

pt_camera with_defaults(pt_camera camera) {
    if (vector(camera.up) == glm::dvec3(0.0))
        camera.up[1] = 1.0;
    if (camera.vertical_fov == 0.0 && camera.projection != PT_PROJECTION_ORTHOGRAPHIC)
        camera.vertical_fov = default_vertical_fov;
    return camera;
}

void check_fields(const pt_camera &camera) {
    Violations violations;
    const Subject subject(violations, "camera");
    subject.require(camera.projection <= PT_PROJECTION_ORTHOGRAPHIC, "projection", camera.projection,
                    "must be a PT_PROJECTION_*: 0 (perspective) or 1 (orthographic)");
    subject.check_each("position", camera.position, length_rule);
    subject.check_each("target", camera.target, length_rule);
    subject.check_each("up", camera.up, finite_rule);
    if (camera.projection == PT_PROJECTION_ORTHOGRAPHIC) {
        subject.require(camera.vertical_fov == 0.0, "vertical_fov", camera.vertical_fov,
                        "must be 0 with an orthographic projection, which has a vertical_extent instead");
        subject.check("vertical_extent", camera.vertical_extent, positive_length_rule);
        for (const auto &[member, value] : {std::pair("aperture", camera.aperture), std::pair("focus", camera.focus)})
            subject.require(value == 0.0, member, value,
                            "must be 0 with an orthographic projection, which has no lens");
    } else {
        subject.check("vertical_fov", camera.vertical_fov, fov_rule);
        subject.require(camera.vertical_extent == 0.0, "vertical_extent", camera.vertical_extent,
                        "must be 0 with a perspective projection, which has a vertical_fov instead");
        subject.check("aperture", camera.aperture, lens_rule);
        subject.check("focus", camera.focus, lens_rule);
    }
    subject.check("shutter_open", camera.shutter_open, shutter_rule);
    subject.check("shutter_close", camera.shutter_close, shutter_rule);
    subject.require(!(camera.shutter_close < camera.shutter_open), "shutter_close", camera.shutter_close,
                    "must be >= shutter_open (" + number_text(camera.shutter_open) + ")");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
}

// Rounds the tangent to 40 bits, because the last bits differ between systems and films of all systems must match.
double tangent(double angle) {
    int exponent = 0;
    const double mantissa = std::frexp(std::tan(angle), &exponent);
    return std::ldexp(std::nearbyint(std::ldexp(mantissa, 40)), exponent - 40);
}

} // namespace

Camera validated_camera(const pt_camera &source) {
    const pt_camera camera = with_defaults(source);
    check_fields(camera);

    Violations violations;
    const Subject subject(violations, "camera");
    const glm::dvec3 position = vector(camera.position);
    const glm::dvec3 target = vector(camera.target);
    subject.require(target != position, "target", target, "must differ from position");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);

    // The blur of a far point has a radius of (lens radius / focus) times the image plane's distance, which must not
    // exceed that distance.
    const double focus = camera.focus > 0.0 ? camera.focus : glm::distance(target, position);
    subject.require(camera.aperture <= 2.0 * focus, "aperture", camera.aperture,
                    "must be at most twice the focus (" + number_text(focus) + ")");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);

    const glm::dvec3 forward = unit_vector(target - position);
    const glm::dvec3 across = glm::cross(forward, unit_vector(vector(camera.up)));
    subject.require(glm::length(across) >= min_sine, "up", vector(camera.up),
                    "must not be parallel to the viewing direction");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);

    const glm::dvec3 right = unit_vector(across);
    return {position,
            right,
            glm::cross(right, forward),
            forward,
            tangent(0.5 * camera.vertical_fov),
            camera.shutter_open,
            camera.shutter_close,
            camera.vertical_extent,
            0.0,
            0.0,
            0.5 * camera.aperture,
            camera.aperture > 0.0 ? focus : 0.0};
}

std::string digest_of(const Camera &camera) {
    Digest digest;
    for (const glm::dvec3 &vector : {camera.position, camera.right, camera.up, camera.forward})
        digest.add(vector);
    for (const double number : {camera.tan_half_fov, camera.shutter_open, camera.shutter_close})
        digest.add(number);
    if (camera.is_orthographic())
        digest.add(camera.vertical_extent);
    if (camera.has_lens())
        for (const double number : {camera.lens_radius, camera.focus})
            digest.add(number);
    return digest.text();
}

} // namespace pt
