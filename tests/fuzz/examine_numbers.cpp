// Accepted inputs must keep the promises of pt.h. Refusals need a code and a message.
#include "lib/base/error.h"
#include "lib/scene/checked_scene.h"
#include "lib/scene/render_settings.h"
#include "lib/view/camera_rules.h"
#include "lib/view/scene_blocks.h"
#include "lib/view/scene_features.h"
#include "lib/view/view.h"
#include "tests/fuzz/input.h"
#include "tests/fuzz/require.h"
#include "tests/support/checked_scene_of.h"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <optional>
#include <span>
#include <string>

namespace fuzz {

namespace {

void require_refusal(const pt::Error &error) {
    const std::string_view message = error.what();
    require(error.code() == PT_ERROR_INVALID_ARGUMENT || error.code() == PT_ERROR_INVALID_SCENE ||
                error.code() == PT_ERROR_UNSUPPORTED,
            "the code of what is refused is the argument's");
    require(message.find(" = ") != std::string_view::npos && message.find(": ") != std::string_view::npos,
            "the message of what is refused names a field, its value and a rule");
}

template <typename Validate>
auto accepted(Validate validate) -> std::optional<decltype(validate())> {
    try {
        return validate();
    } catch (const pt::Error &error) {
        require_refusal(error);
        return std::nullopt;
    }
}

bool is_length(double x) {
    return x == 0.0 || (std::abs(x) >= 1e-18 && std::abs(x) <= 1e18);
}

bool are_lengths(const glm::dvec3 &v) {
    return is_length(v.x) && is_length(v.y) && is_length(v.z);
}

bool is_color(const glm::vec3 &color) {
    const auto in_range = [](float x) { return x >= 0.0F && x <= 1e18F; };
    return in_range(color.r) && in_range(color.g) && in_range(color.b);
}

void require_scene(const pt::Scene &scene) {
    for (const pt::Material &material : scene.materials) {
        require(is_color(material.diffuse) && is_color(material.specular) && is_color(material.emission),
                "colors lie in [0, 1e18]");
        require(material.glossiness >= 0.0F && material.glossiness <= 1e9F, "glossiness lies in [0, 1e9]");
    }
    for (const pt::Sphere &sphere : scene.spheres) {
        require(are_lengths(sphere.center) && are_lengths(sphere.motion), "centers and motions are lengths");
        require(is_length(sphere.radius) && sphere.radius > 0.0, "radii lie in [1e-18, 1e18]");
        require(sphere.material < scene.materials.size(), "spheres have a material");
    }
    for (const pt::Plane &plane : scene.planes) {
        // Squares, sum, root and quotient have rounding errors of 2^-53 each.
        require(std::abs(glm::length(plane.normal) - 1.0) <= 8 * 0x1p-53, "planes' normals are unit vectors");
        require(is_length(plane.offset), "planes' offsets are lengths");
        require(plane.material < scene.materials.size(), "planes have a material");
    }
}

void require_camera(const pt::Camera &camera) {
    // The error is 5 * 2^-53 / 2^-26 at the smallest angle between `up` and the view (camera_rules.cpp). The angle
    // between two such vectors and the square of a length have twice this error.
    constexpr double rounding = 10 * 0x1p-27;
    require(are_lengths(camera.position), "the camera's position is made of lengths");
    const glm::dmat3 axes(camera.right, camera.up, camera.forward);
    const glm::dmat3 errors = glm::transpose(axes) * axes - glm::dmat3(1.0);
    for (int i = 0; i < 9; ++i)
        require(std::abs(errors[i / 3][i % 3]) <= rounding, "the camera's axes are perpendicular unit vectors");
    const double least_tangent = (1.0 - 0x1p-40) * std::tan(0.5e-8); // Keeps 40 bits.
    require((camera.is_orthographic() || camera.view_size >= least_tangent) && std::isfinite(camera.view_size),
            "the field of view lies in [1e-8, pi)");
    require(camera.shutter_open >= 0.0 && camera.shutter_open <= camera.shutter_close && camera.shutter_close <= 1.0,
            "the shutter opens before it closes, in [0, 1]");
    require(camera.lens_radius >= 0.0 && camera.lens_radius <= camera.focus && std::isfinite(camera.focus),
            "the lens is no wider than half a right angle from its focus");
}

void require_settings(const pt::RenderSettings &settings) {
    require(settings.width >= 1 && settings.height >= 1 &&
                std::uint64_t{settings.width} * settings.height <= UINT32_MAX,
            "the image has between 1 and 2^32 - 1 pixels");
    require(settings.row_count >= 1 &&
                std::uint64_t{settings.first_row} + settings.row_count <= std::uint64_t{settings.height},
            "the rows lie in the image");
    require(settings.max_path_length >= 1 && settings.max_path_length <= 1024, "path lengths lie in [1, 1024]");
    require(settings.estimator >= PT_ESTIMATOR_UNIFORM && settings.estimator <= PT_ESTIMATOR_MIS &&
                settings.sampler >= PT_SAMPLER_RANDOM && settings.sampler <= PT_SAMPLER_SOBOL,
            "the methods are known");
}

void require_features(const pt::Features &features, const pt::Scene &scene) {
    require(features.surface_count() <= scene.spheres.size() + scene.planes.size(), "no surface is added");
    require(pt::point_layout(features).block_count() <= pt::sequence_dimensions, "a block has a dimension of its own");
    require(pt::loop_trips_per_sample(features) < (std::uint64_t{1} << 62),
            "the loop trips of a sample can be counted");
}

void require_indices(std::span<const glm::vec4> indices, const pt::Features &features) {
    for (std::uint32_t i = 0; i < features.surface_count(); ++i) {
        const float bits = indices[i / 4][static_cast<int>(i % 4)];
        require(std::isnormal(bits), "no device flushes the bits of an index to 0");
        require(std::bit_cast<std::uint32_t>(bits) - pt::gpu::MATERIAL_INDEX_BITS < features.table_materials,
                "surfaces have a material of the table");
    }
}

void require_words(const std::vector<glm::vec4> &words, const pt::Features &features) {
    const pt::SceneBlocks blocks(features);
    require(words.size() == blocks.word_count, "the scene has as many words as it is said to have");
    for (const glm::vec4 &word : words)
        require(std::isfinite(glm::dot(glm::dvec4(word), glm::dvec4(1))), "the scene's words are finite");
    const auto spheres = std::span(words).first(features[pt::gpu::ID_SPHERE_COUNT]);
    const auto planes = std::span(words).subspan(spheres.size(), features[pt::gpu::ID_PLANE_COUNT]);
    for (const auto &surfaces : {spheres, planes})
        for (const glm::vec4 &surface : surfaces)
            require(glm::length(glm::dvec4(surface)) < std::sqrt(FLT_MAX), "squares of lengths are finite");
    for (const glm::vec4 &sphere : spheres)
        require(sphere.w >= 1e-18F * (1 - 0x1p-24F), "the kernel's radii are at least 1e-18");
    for (const glm::vec4 &plane : planes) // rounded to float32
        require(std::abs(glm::length(glm::dvec3(plane)) - 1.0) <= 2 * 0x1p-24, "the kernel's normals are unit vectors");
    const std::uint64_t reflections = features.scene_in_uniform() ? features.surface_count() : features.table_materials;
    for (std::uint64_t i = 0; i < reflections; ++i) {
        const float probability = words[blocks.diffuse + i * blocks.reflection_step].w;
        require(probability >= 0.0F && probability <= 1.0F, "probabilities lie in [0, 1]");
    }
    if (!features.scene_in_uniform())
        require_indices(std::span(words).subspan(blocks.index), features);
}

void require_frame(const pt::gpu::FrameConstants &frame, double unit) {
    int exponent = 0;
    require(std::frexp(unit, &exponent) == 0.5 && std::abs(exponent) <= 121, "the film's unit is a power of two");
    require(std::isnormal(frame.film_scale), "the film's scale is a normal number");
    const float distance = glm::length(frame.camera.forward);
    require(distance > 0.0F && distance <= 1e18F, "the distance of the image plane is a length");
    require(frame.camera.lens_radius >= 0.0F && frame.camera.lens_radius <= 1e18F &&
                frame.camera.lens_blur <= 1.001F * distance,
            "the lens is as large as lengths are");
}

} // namespace

void examine(const Input &input, std::span<const std::uint8_t>) {
    const auto scene = accepted([&] { return pt::owned_scene(checked_scene_of(input.scene())); });
    const auto camera = accepted([&] { return pt::validated_camera(input.camera); });
    const auto settings = accepted([&] { return pt::validated_render(input.render); });
    if (scene)
        require_scene(*scene);
    if (camera)
        require_camera(*camera);
    if (settings)
        require_settings(*settings);
    if (!scene || !camera || !settings)
        return;
    const pt::PreparedScene prepared(*scene);
    const auto view = accepted([&] { return pt::view_of(prepared, *camera, *settings); });
    if (!view)
        return;
    require_features(view->features, *scene);
    require_words(view->words, view->features);
    require_frame(view->frame, prepared.film_unit);
}

} // namespace fuzz
