#include "lib/view/camera_rules.h"

#include "lib/base/digest.h"
#include "lib/base/rules.h"
#include "lib/base/scaled_vector.h"
#include "lib/scene/view_sizes.h"
#include "lib/view/projection.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace pt {

namespace {

// The least sine s of the angle between `up` and the view. With u = 2^-53, errors are 2 u in forward, u in up and 2 u
// in their cross product, together 5 u / s in the unit vectors. For s >= 5 * 2^-29 this is below float32's rounding,
// 2^-24.
constexpr double min_sine = 0x1p-26;

const char *shutter_rule(double value) {
    if (!std::isfinite(value))
        return "must be finite";
    if (value < 0.0)
        return "must be >= 0";
    return value <= 1.0 ? nullptr : "must be <= 1";
}

static_assert(std::size(view_sizes) == std::size(projection_kinds));

std::string known_projections() {
    std::string text;
    for (std::size_t number = 0; number < std::size(projection_kinds); ++number)
        text += (number == 0                                ? ""
                 : number + 1 < std::size(projection_kinds) ? ", "
                                                            : " or ") +
                std::to_string(number) + " (" + view_sizes[number].projection + ")";
    return text;
}

void check_fields(const pt_camera &camera, const ViewSize &own, const ProjectionKind &kind) {
    Violations violations;
    const Subject subject(violations, "camera");
    subject.require(camera.projection < std::size(projection_kinds), "projection", camera.projection,
                    "must be a PT_PROJECTION_*: " + known_projections());
    subject.check_each("position", camera.position, length_rule);
    subject.check_each("target", camera.target, length_rule);
    subject.check_each("up", camera.up, finite_rule);
    for (const ViewSize &size : view_sizes) {
        const double value = camera.*size.value;
        const bool is_first = std::ranges::find(view_sizes, size.value, &ViewSize::value) == &size;
        if (const char *broken = size.broken_rule(value); broken && &size == &own)
            subject.refuse(size.member, number_text(value), broken);
        else if (is_first && size.value != own.value)
            subject.require(value == 0.0, size.member, value,
                            std::string("must be 0 with ") + own.article + ' ' + own.projection +
                                " projection, which has a " + own.member + " instead");
    }
    subject.check("aperture", camera.aperture, kind.lens_rule);
    subject.check("focus", camera.focus, kind.lens_rule);
    subject.check("shutter_open", camera.shutter_open, shutter_rule);
    subject.check("shutter_close", camera.shutter_close, shutter_rule);
    subject.require(!(camera.shutter_close < camera.shutter_open), "shutter_close", camera.shutter_close,
                    "must be >= shutter_open (" + number_text(camera.shutter_open) + ")");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
}

} // namespace

Camera validated_camera(const pt_camera &given) {
    const std::uint32_t known = given.projection < std::size(projection_kinds) ? given.projection : 0;
    const ViewSize &size = view_sizes[known];
    const ProjectionKind &kind = *projection_kinds[known];
    pt_camera source = given;
    if (vector(source.up) == glm::dvec3(0.0))
        source.up[1] = 1.0;
    if (source.*size.value == 0.0)
        source.*size.value = size.initial;
    check_fields(source, size, kind);

    Violations violations;
    const Subject subject(violations, "camera");
    Camera camera{};
    camera.position = vector(source.position);
    camera.shutter_open = source.shutter_open;
    camera.shutter_close = source.shutter_close;
    camera.projection = source.projection;
    const glm::dvec3 target = vector(source.target);
    subject.require(target != camera.position, "target", target, "must differ from position");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    kind.set_view(camera, source, subject);
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);

    camera.forward = unit_vector(target - camera.position);
    const glm::dvec3 across = glm::cross(camera.forward, unit_vector(vector(source.up)));
    subject.require(glm::length(across) >= min_sine, "up", vector(source.up),
                    "must not be parallel to the viewing direction");
    violations.throw_if_any(PT_ERROR_INVALID_ARGUMENT);
    camera.right = unit_vector(across);
    camera.up = glm::cross(camera.right, camera.forward);
    return camera;
}

std::string digest_of(const Camera &camera) {
    Digest digest;
    for (const glm::dvec3 &vector : {camera.position, camera.right, camera.up, camera.forward})
        digest.add(vector);
    const bool is_perspective = camera.projection == PT_PROJECTION_PERSPECTIVE;
    // Tangents are positive, so other numbers say another projection.
    const double kind = is_perspective ? camera.view_size : 1.0 - camera.projection;
    for (const double number : {kind, camera.shutter_open, camera.shutter_close})
        digest.add(number);
    if (!is_perspective)
        digest.add(camera.view_size);
    if (camera.has_lens())
        for (const double number : {camera.lens_radius, camera.focus})
            digest.add(number);
    return digest.text();
}

} // namespace pt
