#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/image_target.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"

#include <algorithm>
#include <array>
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

// Material i + hidden is material i, hidden from the camera.
constexpr std::uint32_t hidden = 3;

struct Hiding {
    std::string name;
    std::vector<pt_material> materials;
    std::vector<pt_sphere> spheres;
    std::vector<pt_plane> planes;
    pt_camera camera = CourseworkScene::camera();

    Hiding(std::string of, std::array<pt_material, 3> kinds) :
        name(std::move(of)),
        materials(kinds.begin(), kinds.end()) {
        for (pt_material &hidden : kinds) {
            hidden.flags = PT_MATERIAL_HIDDEN_FROM_CAMERA;
            materials.push_back(hidden);
        }
        camera.position[0] = camera.position[1] = camera.position[2] = 0;
        camera.target[0] = camera.target[1] = 0;
        camera.target[2] = -1;
    }

    pt_scene scene() const { return scene_of(materials, spheres, planes); }
};

class HiddenFromCamera : public ContextFixture {
protected:
    std::vector<float> image_of(const Hiding &given, const pt_render &render, std::uint32_t samples) {
        pt_render counted = render;
        counted.flags = PT_RENDER_COVERAGE;
        return render_image(context(), given.scene(), given.camera, counted, samples);
    }

    std::vector<float> coverage() {
        std::vector<float> values(std::size_t{3} * picture_width * picture_height);
        const pt_image target = image_target(values, PT_QUANTITY_COVERAGE);
        EXPECT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
        return values;
    }
};

pt_sphere ball(double x, double y, double z, double radius, std::uint32_t material) {
    return {{x, y, z}, radius, {0, 0, 0}, material, 0};
}

// Every surface emits 1, so a vertex that reflects half sends exactly 1.5.
constexpr std::uint32_t shining = 0;

Hiding closed(const std::string &name) {
    const pt_material material{{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {1, 1, 1}, 0, 0};
    return {name, {material, material, material}};
}

std::vector<Hiding> closed_scenes() {
    std::vector<Hiding> scenes;
    const auto add = [&](const std::string &name) -> Hiding & { return scenes.emplace_back(closed(name)); };

    Hiding &into_shell = add("into a shell");
    into_shell.spheres = {ball(0, 0, -9, 1, shining), ball(1, 1, -8, 0.5, shining),
                          ball(0, 0, -9, 4, shining + hidden)};

    Hiding &in_sky = add("under a sky");
    in_sky.spheres = {ball(0, 0, -9, 1, shining), ball(0, 0, -3, 40, shining + hidden)};

    Hiding &out_of_shell = add("out of a shell, under a sky");
    out_of_shell.spheres = {ball(0, 0, -9, 1, shining), ball(0, 0, 0, 2, shining + hidden),
                            ball(0, 0, -3, 40, shining + hidden)};

    Hiding &between_planes = add("between planes");
    between_planes.spheres = {ball(0, 0, -9, 1, shining), ball(1.5, 0, -9, 0.75, shining)};
    between_planes.planes = {{{0, 0, 1}, 6, shining + hidden, 0}, {{0, 0, 1}, 12, shining + hidden, 0}};

    Hiding &globes = add("globes");
    globes.spheres = {ball(0, 0, -9, 1, shining), ball(0, 0, -1e7 - 5, 1e7, shining + hidden),
                      ball(0, 0, -1e7 + 3, 1e7, shining + hidden)};

    Hiding &cut = add("a shell that cuts a floor and a ball");
    cut.spheres = {ball(0, 0, -9, 1, shining), ball(1, 0.5, -8.5, 1, shining + hidden), ball(0, 0, -3, 40, shining)};
    cut.planes = {{{0, 1, 0}, 0.5, shining, 0}};

    Hiding &moving = add("a shell that moves with its ball");
    moving.spheres = {ball(-0.2, 0, -9, 1, shining), ball(-0.2, 0, -9, 2, shining + hidden)};
    for (pt_sphere &sphere : moving.spheres)
        sphere.motion[0] = 0.4;

    Hiding &past = add("a ball that passes a wall");
    past.spheres = {ball(0, 0, -9, 1, shining), ball(0, 0, -3, 40, shining + hidden)};
    past.spheres[0].motion[2] = -6;
    past.planes = {{{0, 0, 1}, 11, shining + hidden, 0}};

    Hiding &parallel = add("by parallel rays");
    parallel.spheres = {ball(0, 0, -9, 1, shining), ball(0, 0, -9, 4, shining + hidden)};
    parallel.camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
    parallel.camera.vertical_fov = 0;
    parallel.camera.vertical_extent = 5;

    Hiding &tree = add("a tree in a shell");
    std::mt19937 random(3);
    const auto share = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
    for (int i = 0; i < 120; ++i)
        tree.spheres.push_back(ball(4 * share() - 2, 4 * share() - 2, -11 + 4 * share(), 0.1 + 0.4 * share(), shining));
    tree.spheres.push_back(ball(0, 0, -9, 6, shining + hidden));
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

TEST_F(HiddenFromCamera, ClosedScenesNeitherLeakNorLoseLight) {
    std::uint32_t estimator = PT_ESTIMATOR_COSINE;
    for (const Hiding &given : closed_scenes()) {
        SCOPED_TRACE(given.name);
        pt_render render = render_of(picture_width, picture_height, 2);
        render.estimator =
            std::exchange(estimator, estimator == PT_ESTIMATOR_COSINE ? PT_ESTIMATOR_BSDF : PT_ESTIMATOR_COSINE);
        const std::vector<float> image = image_of(given, render, 16);
        const std::vector<float> covered = coverage();
        EXPECT_LE(largest_error(image, covered, 1.5), few_roundings);
        EXPECT_GT(largest_error(image, covered, 1.545), few_roundings);
        EXPECT_TRUE(std::ranges::any_of(covered, [](float share) { return share == 1.0F; }));
        const bool has_a_sky = given.name == "a shell that cuts a floor and a ball";
        EXPECT_NE(has_a_sky, std::ranges::any_of(covered, [](float share) { return share == 0.0F; }));
    }
}

TEST_F(HiddenFromCamera, FlagsThatThereAreNotAreRefused) {
    Hiding given = closed("");
    given.materials[4].flags = 6;
    const pt_scene scene = given.scene();
    EXPECT_EQ(pt_set_scene(context(), &scene), PT_ERROR_INVALID_SCENE);
    EXPECT_EQ(std::string(pt_last_error(context())),
              "materials[4].flags = 6: must be 0 or PT_MATERIAL_HIDDEN_FROM_CAMERA (1)");
}

} // namespace

} // namespace hiding
