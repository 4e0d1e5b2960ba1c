#include "tests/invariance/invariance_scene.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace hiding {

namespace {

constexpr std::uint32_t picture_width = 40;
constexpr std::uint32_t picture_height = 30;

enum Kind : std::uint32_t { shining, hidden };

// Every surface emits 1, so a vertex that reflects half sends exactly 1.5.
struct Closed : InvarianceScene {
    std::string name;

    explicit Closed(std::string of) : name(std::move(of)) {
        materials.assign(2, {{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {1, 1, 1}, 0, 0});
        materials[hidden].flags = PT_MATERIAL_HIDDEN_FROM_CAMERA;
        camera = camera_at({0, 0, 0}, {0, 0, -1}, camera.vertical_fov);
    }
};

pt_sphere ball(double x, double y, double z, double radius, Kind kind) {
    return {{x, y, z}, radius, {0, 0, 0}, kind, 0};
}

std::vector<Closed> closed_scenes() {
    std::vector<Closed> scenes;
    const auto add = [&](const std::string &name) -> Closed & { return scenes.emplace_back(name); };

    Closed &into_shell = add("into a shell");
    into_shell.spheres = {ball(0, 0, -9, 1, shining), ball(1, 1, -8, 0.5, shining), ball(0, 0, -9, 4, hidden)};

    Closed &in_sky = add("under a sky");
    in_sky.spheres = {ball(0, 0, -9, 1, shining), ball(0, 0, -3, 40, hidden)};

    Closed &out_of_shell = add("out of a shell, under a sky");
    out_of_shell.spheres = {ball(0, 0, -9, 1, shining), ball(0, 0, 0, 2, hidden), ball(0, 0, -3, 40, hidden)};

    Closed &between_planes = add("between planes");
    between_planes.spheres = {ball(0, 0, -9, 1, shining), ball(1.5, 0, -9, 0.75, shining)};
    between_planes.planes = {{{0, 0, 1}, 6, hidden, 0}, {{0, 0, 1}, 12, hidden, 0}};

    Closed &globes = add("globes");
    globes.spheres = {ball(0, 0, -9, 1, shining), ball(0, 0, -1e7 - 5, 1e7, hidden), ball(0, 0, -1e7 + 3, 1e7, hidden)};

    Closed &cut = add("a shell that cuts a floor and a ball");
    cut.spheres = {ball(0, 0, -9, 1, shining), ball(1, 0.5, -8.5, 1, hidden), ball(0, 0, -3, 40, shining)};
    cut.planes = {{{0, 1, 0}, 0.5, shining, 0}};

    Closed &moving = add("a shell that moves with its ball");
    moving.spheres = {ball(-0.2, 0, -9, 1, shining), ball(-0.2, 0, -9, 2, hidden)};
    for (pt_sphere &sphere : moving.spheres)
        sphere.motion[0] = 0.4;

    Closed &past = add("a ball that passes a wall");
    past.spheres = {ball(0, 0, -9, 1, shining), ball(0, 0, -3, 40, hidden)};
    past.spheres[0].motion[2] = -6;
    past.planes = {{{0, 0, 1}, 11, hidden, 0}};

    Closed &parallel = add("by parallel rays");
    parallel.spheres = {ball(0, 0, -9, 1, shining), ball(0, 0, -9, 4, hidden)};
    parallel.camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
    parallel.camera.vertical_fov = 0;
    parallel.camera.vertical_extent = 5;

    Closed &tree = add("a tree in a shell");
    std::mt19937 random(3);
    const auto share = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
    for (int i = 0; i < 120; ++i)
        tree.spheres.push_back(ball(4 * share() - 2, 4 * share() - 2, -11 + 4 * share(), 0.1 + 0.4 * share(), shining));
    tree.spheres.push_back(ball(0, 0, -9, 6, hidden));
    return scenes;
}

constexpr double few_roundings = 8.0 * 0x1p-24;

double largest_error(const std::vector<float> &image, const std::vector<float> &coverage, double radiance) {
    double largest = 0.0;
    for (std::size_t i = 0; i < image.size(); ++i)
        largest =
            std::max(largest, std::abs(static_cast<double>(image[i]) - radiance * static_cast<double>(coverage[i])));
    return largest / radiance;
}

using HiddenFromCamera = ContextFixture;

TEST_F(HiddenFromCamera, ClosedScenesNeitherLeakNorLoseLight) {
    std::uint32_t estimator = PT_ESTIMATOR_COSINE;
    for (const Closed &given : closed_scenes()) {
        SCOPED_TRACE(given.name);
        pt_render render = render_of(picture_width, picture_height, 2);
        render.flags = PT_RENDER_COVERAGE;
        render.estimator =
            std::exchange(estimator, estimator == PT_ESTIMATOR_COSINE ? PT_ESTIMATOR_BSDF : PT_ESTIMATOR_COSINE);
        const std::vector<float> image = render_image(context(), given.scene(), given.camera, render, 16);
        const std::vector<float> covered =
            values_of(context(), std::size_t{picture_width} * picture_height, PT_QUANTITY_COVERAGE);
        EXPECT_LE(largest_error(image, covered, 1.5), few_roundings);
        EXPECT_GT(largest_error(image, covered, 1.545), few_roundings);
        EXPECT_TRUE(std::ranges::any_of(covered, [](float share) { return share == 1.0F; }));
        const bool has_a_sky = given.name == "a shell that cuts a floor and a ball";
        EXPECT_NE(has_a_sky, std::ranges::any_of(covered, [](float share) { return share == 0.0F; }));
    }
}

} // namespace

} // namespace hiding
