// PT_TEST_TREE_SCENES sets the number of scenes.
#include "tests/geometry/tree_scenes.h"
#include "tests/kernel/kernel_render.h"
#include "tests/support/checked_scene_of.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace {

using FilmWords = KernelRender::FilmWords;

std::size_t scene_count() {
    const char *const wanted = std::getenv("PT_TEST_TREE_SCENES");
    return wanted ? std::stoul(wanted) : 8;
}

std::size_t most_spheres() {
    return scene_count() > 100 ? 2000 : 600;
}

constexpr std::uint32_t word_of_sides[6][2] = {{1, 2}, {1, 3}, {2, 0},
                                               {2, 1}, {2, 2}, {2, 3}}; // low x, y, z, then high x, y, z

template <typename Change>
void change_boxes(std::vector<glm::uvec4> &tree, std::uint32_t node_count, Change &&change) {
    for (std::uint32_t node = 0; node < node_count; ++node) {
        glm::uvec4 *const words = &tree[std::size_t{node} * pt::gpu::TREE_NODE_WORDS];
        std::uint32_t *sides[6];
        for (int i = 0; i < 6; ++i)
            sides[i] = &words[word_of_sides[i][0]][static_cast<int>(word_of_sides[i][1])];
        change(words[0], sides);
    }
}

// Boxes that cover the whole grid make a walk test every sphere.
void open_boxes(std::vector<glm::uvec4> &tree, std::uint32_t node_count) {
    change_boxes(tree, node_count, [](glm::uvec4 &head, std::uint32_t *const sides[6]) {
        constexpr std::uint32_t exponents = 23 | 23 << 5 | 23 << 10; // boxes reach 255 * 2^23 steps
        constexpr std::uint32_t lowest = ~pt::gpu::TREE_REACH + 1;
        head = {lowest, lowest, lowest, (head.w & ~0x7fffU) | exponents};
        for (int i = 0; i < 6; ++i)
            *sides[i] = i < 3 ? 0U : 0xffffffffU;
    });
}

void shrink_boxes(std::vector<glm::uvec4> &tree, std::uint32_t node_count) {
    change_boxes(tree, node_count, [](const glm::uvec4 &, std::uint32_t *const sides[6]) {
        for (int i = 0; i < 6; ++i)
            for (int shift = 0; shift < 32; shift += 8) {
                const std::uint32_t side = *sides[i] >> shift & 255;
                const std::uint32_t moved = i < 3 ? std::min(side + 8, 255U) : std::max(side, 8U) - 8;
                *sides[i] = (*sides[i] & ~(255U << shift)) | moved << shift;
            }
    });
}

struct Compared {
    bool same;
    bool shrunk_same;
};

Compared compare(const pt::PreparedScene &prepared, const pt::Camera &camera) {
    // Without boxes, the spheres use up the 65,535 rounds of a loop that some drivers allow.
    const std::size_t spheres = prepared.tree->sphere_count();
    KernelRender render(pt::view_of(prepared, camera, KernelRender::settings(spheres > 100 ? 2 : 4)));
    render.take(spheres > 400 ? 2 : spheres > 40 ? 4 : 8);
    Probe probe = render.probe_of_tree();
    const FilmWords walked = render.film_by(probe);
    render.radiance(walked);
    shrink_boxes(render.tree(), prepared.tree->node_count());
    const FilmWords shrunk = render.film_by(probe);
    open_boxes(render.tree(), prepared.tree->node_count());
    const FilmWords tested = render.film_by(probe);
    render.radiance(tested);
    return {walked == tested, shrunk == tested};
}

pt::PreparedScene all_in_a_tree(const pt::Scene &scene) {
    const std::vector<pt_sphere> spheres = caller_spheres(scene.spheres);
    return prepared_scene_of({scene.materials, {spheres, {}}, scene.planes}, 1);
}

Compared compare_with_capsules(const pt::Scene &scene, const pt::Camera &camera) {
    std::vector<pt_sphere> spheres;
    std::vector<pt_sphere> capsules;
    for (const pt_sphere &sphere : caller_spheres(scene.spheres)) {
        const bool is_swept = sphere.material != 0 && spheres.size() > capsules.size();
        (is_swept ? capsules : spheres).push_back(sphere);
        if (!is_swept)
            continue;
        const std::size_t other = capsules.size() % spheres.size();
        std::ranges::copy(spheres[other].center, capsules.back().motion);
        if (capsules.size() % 3 == 0) {
            std::ranges::copy(capsules.front().center, capsules.back().center);
            capsules.back().radius = capsules.front().radius;
        }
    }
    std::vector<pt_sphere_array> arrays;
    constexpr std::uint32_t stride = sizeof(pt_sphere);
    if (!capsules.empty()) {
        arrays.push_back(array_of(capsules.size(), {capsules[0].center, stride, PT_TYPE_FLOAT64},
                                  {&capsules[0].radius, stride, PT_TYPE_FLOAT64}));
        arrays[0].material = {&capsules[0].material, stride, PT_TYPE_UINT32};
        arrays[0].end = {capsules[0].motion, stride, PT_TYPE_FLOAT64};
    }
    return compare(prepared_scene_of({scene.materials, {spheres, arrays}, scene.planes}, 1), camera);
}

TEST(Tree, WalksFindWhatTestingEverySphereFinds) {
    for (const bool with_capsules : {false, true}) {
        TreeScenes scenes(with_capsules ? 2 : 1);
        const std::size_t most = with_capsules && scene_count() <= 100 ? 100 : most_spheres();
        std::size_t caught = 0;
        for (std::size_t i = 0; i < scene_count(); ++i) {
            const pt::Scene scene = scenes.next(most);
            const pt::Camera camera = scenes.camera(scene);
            SCOPED_TRACE("scene " + std::to_string(i) + ": " + scenes.kind() + ", " +
                         std::to_string(scene.spheres.size()) + (with_capsules ? ", capsules" : ""));
            const Compared compared =
                with_capsules ? compare_with_capsules(scene, camera) : compare(all_in_a_tree(scene), camera);
            EXPECT_TRUE(compared.same);
            caught += compared.shrunk_same ? 0 : 1;
        }
        EXPECT_GT(caught, scene_count() / 4) << "boxes that are too small are not noticed";
    }
}

// Compares with a tree that has the shape of the reflected spheres' tree. Its boxes are as good, but in reverse order.
// Returns nothing if the trees are equal or no shape was kept.
std::optional<bool> is_seen_alike(const pt::Scene &scene, const pt::Camera &camera) {
    const std::vector<pt_sphere> spheres = caller_spheres(scene.spheres);
    std::vector<pt_sphere> reflected = spheres;
    for (pt_sphere &sphere : reflected)
        for (int axis = 0; axis < 3; ++axis) {
            sphere.center[axis] = -sphere.center[axis];
            sphere.motion[axis] = -sphere.motion[axis];
        }
    pt::WorkProgress nobody;
    const auto prepared = [&](const std::vector<pt_sphere> &of, const pt::PreparedScene *shape) {
        return pt::PreparedScene({scene.materials, {of, {}}, scene.planes}, 1, shape, nobody);
    };
    const pt::PreparedScene first = prepared(reflected, nullptr);
    const pt::PreparedScene with_shape = prepared(spheres, &first);
    const pt::PreparedScene anew = prepared(spheres, nullptr);
    if (with_shape.tree->words() == anew.tree->words())
        return std::nullopt;
    const KernelRender render_kept(pt::view_of(with_shape, camera, KernelRender::settings(3)));
    const KernelRender render_new(pt::view_of(anew, camera, KernelRender::settings(3)));
    EXPECT_EQ(render_kept.features(), render_new.features());
    Probe probe = render_kept.probe_of_tree();
    const FilmWords film_kept = render_kept.film_by(probe);
    probe.set_scene(render_new.words());
    const FilmWords film_new = render_new.film_by(probe);
    render_kept.radiance(film_kept);
    return film_kept == film_new;
}

TEST(Tree, WalksFindTheSameWhateverItsShape) {
    TreeScenes scenes(3);
    const std::size_t count = 3 * scene_count() / 4;
    std::size_t compared = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const pt::Scene scene = scenes.next(most_spheres());
        const pt::Camera camera = scenes.camera(scene);
        SCOPED_TRACE("scene " + std::to_string(i) + ": " + scenes.kind() + ", " + std::to_string(scene.spheres.size()));
        const auto alike = is_seen_alike(scene, camera);
        EXPECT_TRUE(alike.value_or(true));
        compared += alike ? 1 : 0;
    }
    EXPECT_GE(compared, count / 4) << "hardly any shape was kept";
}

double mean_of(const std::vector<float> &values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// A walk in steps (tree_path.glsl) gives the bits of a whole walk, if the driver neither contracts nor reorders.
TEST(TreePath, TakeTheSamplesOfWholeWalks) {
    TreeScenes scenes(23);
    const bool is_exact = probe_device().info().kind == PT_DEVICE_CPU;
    int beyond_branches = 0;
    for (const std::uint32_t length : {1U, 2U, 3U, 4U, 9U}) {
        const pt::Scene scene = scenes.next(250);
        pt::Camera camera = scenes.camera(scene);
        if (length % 2 == 1) {
            camera.lens_radius = 0.05;
            camera.focus = 2.0;
        }
        KernelRender render(pt::view_of(all_in_a_tree(scene), camera, KernelRender::settings(length)));
        SCOPED_TRACE(std::to_string(scene.spheres.size()) + " spheres, " + scenes.kind() + ", length " +
                     std::to_string(length));
        const std::uint32_t lamps = render.features()[pt::gpu::ID_LAMP_COUNT];
        beyond_branches += lamps > pt::branch_count(render.features()) && lamps <= pt::gpu::EVERY_LAMP_LIMIT ? 1 : 0;
        render.take(length > 4 ? 4 : 8);
        Probe whole = render.probe_of_tree();
        const FilmWords expected = render.film_by(whole);
        Probe steps = render.probe_of_tree(8);
        const FilmWords found = render.film_by(steps);
        EXPECT_TRUE(found == expected || !is_exact);
        const double mean = mean_of(render.radiance(expected));
        EXPECT_NEAR(mean_of(render.radiance(found)), mean, 1e-4 * mean);
    }
    EXPECT_GT(beyond_branches, 0);
}

TEST(Tree, WalksThatADriverCutsAreTold) {
    const std::uint64_t budget = probe_device().limits().loop_trip_budget;
    if (budget > 1'000'000)
        GTEST_SKIP() << "this driver does not end loops";
    TreeScenes scenes(10);
    pt::Scene scene;
    scene.materials = {{glm::vec3(0.5F), glm::vec3(0.0F), glm::vec3(1.0F), 0.0F},
                       {glm::vec3(0.5F), glm::vec3(0.0F), glm::vec3(0.0F), 0.0F}};
    for (std::uint64_t i = 0; i < 2 * budget; ++i)
        scene.spheres.push_back(
            {{scenes.uniform(-2, 2), scenes.uniform(-2, 2), 0}, 1e-3, glm::dvec3(0.0), i == 0 ? 0U : 1U});
    const pt::PreparedScene prepared = all_in_a_tree(scene);
    const pt::Camera camera{{0, 0, 5}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0.0, 1.0};
    KernelRender render(pt::view_of(prepared, camera, KernelRender::settings(2)));
    render.take(1);
    Probe probe = render.probe_of_tree();
    const FilmWords walked = render.film_by(probe);
    EXPECT_NO_THROW(render.radiance(walked));
    open_boxes(render.tree(), prepared.tree->node_count());
    const FilmWords cut = render.film_by(probe);
    if (cut == walked)
        GTEST_SKIP() << "this version of the driver does not end loops";
    EXPECT_ANY_THROW(render.radiance(cut));
}

} // namespace
