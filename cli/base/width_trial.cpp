#include "cli/base/width_trial.h"

#include "lib/base/struct_size.h"

#include <pt/devices.h>
#include <pt/pt.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <ctime>
#include <limits>
#include <memory>
#include <random>
#include <string_view>
#include <vector>

namespace cli {
namespace {

constexpr std::uint64_t run_count = 6;        // if half are disturbed, all are in 1 of 64
constexpr std::uint32_t run_samples = 64;     // milliseconds
constexpr std::uint32_t tree_run_samples = 8; // walks take eight times as long
constexpr std::uint32_t trial_width = 64;     // full vectors of 16 pixels
constexpr std::uint32_t trial_height = 32;
static_assert(2 * run_count * run_samples * trial_width * trial_height < trial_pays_from / 10,
              "runs must cost less than kernels");

struct TrialScene {
    explicit TrialScene(bool has_tree) {
        std::minstd_rand random(1);
        const auto between = [&](double low, double high) {
            return low + (high - low) * static_cast<double>(random() - 1) / (std::minstd_rand::max() - 1);
        };
        const unsigned int count = has_tree ? 1000 : 4;
        const double radius = has_tree ? 0.2 : 0.9;
        spheres.push_back({.center = {2, 6.5, 6}, .radius = 0.6, .motion = {}, .material = 1, .reserved = 0});
        for (unsigned int i = 0; i < count; ++i)
            spheres.push_back({.center = {between(-4, 4), between(0.05, 4), between(-2, 2)},
                               .radius = radius * between(0.4, 1),
                               .motion = {},
                               .material = 0,
                               .reserved = 0});
        std::ranges::fill(materials[0].diffuse, 0.6F);
        std::ranges::fill(materials[1].emission, 50.0F);
    }

    pt_result describe(pt_context *context) const {
        auto scene = pt::sized<pt_scene>();
        scene.material_count = static_cast<std::uint32_t>(materials.size());
        scene.materials = materials.data();
        scene.sphere_count = static_cast<std::uint32_t>(spheres.size());
        scene.spheres = spheres.data();
        scene.plane_count = 1;
        scene.planes = &floor;
        auto camera = pt::sized<pt_camera>();
        camera.position[1] = camera.target[1] = 2;
        camera.position[2] = 6.5;
        const pt_result result = pt_set_scene(context, &scene);
        return result < 0 ? result : pt_set_camera(context, &camera);
    }

    std::vector<pt_sphere> spheres;
    std::array<pt_material, 2> materials{};
    pt_plane floor{.normal = {0, 1, 0}, .offset = 0, .material = 0, .reserved = 0};
};

pt_result take_samples(pt_context *context, std::uint32_t count, std::uint64_t seed) {
    auto render = pt::sized<pt_render>();
    render.width = trial_width;
    render.height = trial_height;
    render.max_path_length = 3;
    render.seed = seed;
    auto samples = pt::sized<pt_accumulate_info>();
    samples.sample_count = count;
    const pt_result result = pt_set_render(context, &render);
    return result < 0 ? result : pt_accumulate(context, &samples);
}

} // namespace

double trial_seconds(unsigned int bits, const std::string &device, bool has_tree) {
    constexpr double failed = std::numeric_limits<double>::infinity();
    auto info = pt::sized<pt_create_info>();
    info.flags = PT_CREATE_NO_SCENE_KERNELS;
    info.device = device.c_str();
    pt_context *created = nullptr;
    if (pt_create(&info, &created) < 0)
        return failed;
    const std::unique_ptr<pt_context, decltype(&pt_destroy)> context(created, &pt_destroy);
    pt_device_info found{};
    if (pt_get_context_device(created, &found) < 0 ||
        std::string_view(found.name).find(std::to_string(bits) + " bits") == std::string_view::npos ||
        TrialScene(has_tree).describe(created) < 0 || take_samples(created, 1, 0) < 0)
        return failed;
    double least = failed;
    for (std::uint64_t seed = 0; seed < run_count; ++seed) {
        const std::clock_t start = std::clock();
        if (take_samples(created, has_tree ? tree_run_samples : run_samples, seed) < 0)
            return failed;
        least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return least;
}

} // namespace cli
