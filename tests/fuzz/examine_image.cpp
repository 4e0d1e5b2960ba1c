// Images must be finite, without rejected samples, and independent of the split over calls.
#include "lib/base/error.h"
#include "lib/scene/checked_scene.h"
#include "lib/scene/render_settings.h"
#include "lib/view/camera_rules.h"
#include "lib/view/view.h"
#include "tests/fuzz/input.h"
#include "tests/fuzz/on_device.h"
#include "tests/support/checked_scene_of.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <random>
#include <string>

namespace fuzz {

namespace {

bool can_be_rendered(const Input &input) {
    constexpr double most_tests = 4e6;
    const pt_render &render = input.render;
    const double pixels = static_cast<double>(render.width) * render.height;
    const double surfaces = static_cast<double>(1 + input.spheres.size() + input.planes.size());
    const double rays = 8.0 * (render.max_path_length == 0 ? 6 : render.max_path_length);
    const bool has_indices = std::uint64_t{render.first_sample} + input.sample_count <= std::uint64_t{1} << 32;
    return has_indices && pixels <= most_pixels && pixels * input.sample_count * surfaces * rays <= most_tests;
}

bool conserves_energy(const pt_material &material) {
    for (std::size_t i = 0; i < 3; ++i)
        if (static_cast<double>(material.diffuse[i]) + material.specular[i] > 1.0)
            return false;
    return true;
}

// For path length K and brightest emission L, a sample's expectation is at most K L. By Markov's inequality it exceeds
// 2^20 L with a probability of at most K / 2^20. The first point of plain Halton is 0 in all dimensions, which hits
// sharp lobes.
bool may_lose_samples(const Input &input) {
    const bool follows_lobe = input.render.estimator == PT_ESTIMATOR_BEST ||
                              input.render.estimator == PT_ESTIMATOR_BSDF || input.render.estimator == PT_ESTIMATOR_MIS;
    return !std::ranges::all_of(input.materials, conserves_energy) ||
           (input.render.sampler == PT_SAMPLER_HALTON && !follows_lobe);
}

bool accepted(pt_result result) {
    if (result != PT_OK)
        require(result == PT_ERROR_INVALID_ARGUMENT || result == PT_ERROR_INVALID_SCENE ||
                    result == PT_ERROR_UNSUPPORTED,
                std::string(pt_result_name(result)) + ": " + pt_last_error(context()));
    return result == PT_OK;
}

bool set_all(const Input &input) {
    const pt_scene scene = input.scene();
    return accepted(pt_set_scene(context(), &scene)) && accepted(pt_set_camera(context(), &input.camera)) &&
           accepted(pt_set_render(context(), &input.render));
}

void examine_one(const Input &input) {
    if (!set_all(input))
        return;
    take_samples(input.sample_count);
    const Pixels radiance = read_radiance();
    require(std::ranges::none_of(read_pixels(PT_QUANTITY_STANDARD_ERROR), [](float x) { return std::isnan(x); }),
            "standard errors are numbers");
    require(stats().sample_count == input.sample_count, "all samples were taken");
    require(stats().rejected_samples == 0 || may_lose_samples(input), "no samples were left out");
    if (input.sample_count == 1)
        return;
    require(set_all(input), "what was accepted is accepted again");
    take_samples(1);
    take_samples(input.sample_count - 1);
    const Pixels split = read_pixels(PT_QUANTITY_RADIANCE);
    require(std::memcmp(radiance.data(), split.data(), sizeof radiance) == 0,
            "the bits do not depend on how samples are split over calls");
}

std::optional<pt::Features> features(const Input &input) {
    try {
        return pt::view_of(pt::PreparedScene(pt::owned_scene(checked_scene_of(input.scene()))),
                           pt::validated_camera(input.camera), pt::validated_render(input.render))
            .features;
    } catch (const pt::Error &) {
        return std::nullopt;
    }
}

void change_one_number(Input &input, std::mt19937_64 &random) {
    std::vector<double *> lengths;
    std::vector<float *> colors;
    const auto add = [](auto &all, auto &values) {
        for (auto &value : values)
            all.push_back(&value);
    };
    add(lengths, input.camera.position);
    add(lengths, input.camera.target);
    for (pt_sphere &sphere : input.spheres) {
        add(lengths, sphere.center);
        lengths.push_back(&sphere.radius);
        if (sphere.motion[0] != 0.0)
            add(lengths, sphere.motion);
    }
    for (pt_plane &plane : input.planes) {
        add(lengths, plane.normal);
        lengths.push_back(&plane.offset);
    }
    for (pt_material &material : input.materials) {
        if (material.emission[0] > 0.0F)
            add(colors, material.emission);
        if (material.glossiness > 0.0F)
            colors.push_back(&material.glossiness);
    }
    const std::array words{random(), random(), random()};
    Numbers numbers(std::as_bytes(std::span(words)));
    if (numbers.one_in(4) && !colors.empty())
        *colors[random() % colors.size()] = numbers.color();
    else
        *lengths[random() % lengths.size()] = numbers.length();
}

} // namespace

// Most changed inputs need the same kernel. Others are skipped, because building a kernel takes long.
void examine(const Input &input, std::span<const std::uint8_t> bytes) {
    constexpr std::uint32_t neighbour_count = 255;
    constexpr std::uint32_t most_changes = 4;
    if (!can_be_rendered(input))
        return;
    examine_one(input);
    std::seed_seq seed(bytes.begin(), bytes.end());
    std::mt19937_64 random(seed);
    for (std::uint32_t i = 0; i < neighbour_count; ++i) {
        Input neighbour = input;
        for (std::uint64_t change = random() % most_changes; change < most_changes; ++change)
            change_one_number(neighbour, random);
        if (features(neighbour) == features(input))
            examine_one(neighbour);
    }
}

} // namespace fuzz
