// What camera rays meet first in random scenes of 1 to 2,000 spheres, in a tree and in a list, from wherever a camera
// may be, against long double. PT_TEST_MANY asks for 600 scenes, PT_TEST_FIRST_SCENE for those from one of them on. Run
// alone with --gtest_filter=RandomFirstHit*.
#include "lib/kernel/gpu_scene.h"
#include "tests/device/first_hit_scenes.h"
#include "tests/device/tree_fixture.h"
#include "tests/device/tree_scenes.h"
#include "tests/support/context_calls.h"
#include "tests/support/first_hit_reference.h"
#include "tests/support/scene_of.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace random_first_hits {

namespace {

using namespace first_hits;

// Of a crop of columns x rows.
struct Shot : Given {
    std::string name;
    pt_render render{};
    std::uint32_t first_column = 0;
};

constexpr std::uint32_t columns = 16; // of the crop
constexpr std::uint32_t rows = 2;

struct Pixels {
    std::vector<std::uint32_t> objects;
    std::vector<float> depths; // three a pixel

    bool operator==(const Pixels &) const = default;
};

// Of pixels that float32 can be sure of, and of those that see a sphere.
struct Counts {
    std::uint32_t pixels = 0;
    std::uint32_t certain = 0;
    std::uint32_t spheres = 0;
};

class RandomFirstHit : public TreeFixture {
protected:
    static void read(pt_context *from, const Shot &given, std::uint32_t quantity, std::uint32_t format, void *data,
                     std::size_t bytes) {
        pt_image target{};
        target.struct_size = sizeof target;
        target.quantity = quantity;
        target.format = format;
        target.data = data;
        target.size_bytes = bytes;
        target.x = given.first_column;
        target.width = columns;
        target.height = rows;
        ASSERT_EQ(pt_readback(from, &target), PT_OK) << pt_last_error(from);
    }

    static Pixels seen_by(pt_context *context, const Shot &given) {
        const pt_scene scene = given.scene();
        Pixels pixels{std::vector<std::uint32_t>(columns * rows), std::vector<float>(3 * columns * rows)};
        set_picture(context, scene, given.camera, given.render);
        read(context, given, PT_QUANTITY_OBJECT, PT_FORMAT_R32UI, pixels.objects.data(), 4 * pixels.objects.size());
        read(context, given, PT_QUANTITY_DEPTH, PT_FORMAT_RGB32F, pixels.depths.data(), 4 * pixels.depths.size());
        return pixels;
    }

    static Counts judge(pt_context *context, bool has_tree, const Shot &given) {
        const Pixels pixels = seen_by(context, given);
        const pt_scene scene = given.scene();
        const pt::PreparedScene prepared(pt::checked_scene(scene), has_tree ? 1 : UINT32_MAX);
        View view(given.camera, given.render);
        view.start_distance =
            pt::gpu_scene(prepared, pt::validated_camera(given.camera), pt::validated_render(given.render))
                .start_distance;
        view.tree_step = prepared.tree ? prepared.tree->grid().step : 0.0;
        Counts counts;
        for (std::uint32_t pixel = 0; pixel < columns * rows; ++pixel) {
            const std::uint32_t column = given.first_column + pixel % columns;
            const std::uint32_t row = given.render.first_row + pixel / columns;
            const Ray ray = view.ray(column, row, 0.5L, 0.5L, 0.5L);
            const std::optional<Meeting> met = first_met(scene, view, ray);
            ++counts.pixels;
            if (!met)
                continue;
            ++counts.certain;
            counts.spheres += met->object < given.spheres.size() ? 1 : 0;
            EXPECT_EQ(pixels.objects[pixel], met->object) << column << ", " << row;
            const Real depth = met->distance * glm::dot(ray.direction, view.forward);
            const Real tolerance = met->tolerance + 8.0L * rounding * met->distance;
            if (met->object != PT_NO_OBJECT) {
                EXPECT_NEAR(pixels.depths[3 * pixel], static_cast<double>(depth), static_cast<double>(tolerance))
                    << column << ", " << row;
            }
            if (testing::Test::HasFailure())
                break;
        }
        return counts;
    }
};

class RandomScenes {
public:
    Shot next() {
        const pt::Scene scene = scenes_.next(2000);
        Shot given;
        given.name = scenes_.kind() + ", " + std::to_string(scene.spheres.size()) + " spheres";
        for (const pt::Material &material : scene.materials)
            given.materials.push_back({{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {material.emission.r, 0, 0}, 0, 0});
        if (chance(0.3))
            given.materials[2].flags = PT_MATERIAL_HIDDEN_FROM_CAMERA;
        given.spheres = caller_spheres(scene.spheres);
        for (const pt::Plane &plane : scene.planes)
            given.planes.push_back({{plane.normal.x, plane.normal.y, plane.normal.z}, plane.offset, 1, 0});
        if (chance(0.4)) // a sky, which is in the tree unless it is far away
            given.spheres.push_back({{0, 0, 0}, decades(0.8, 3), {0, 0, 0}, 1, 0});
        set_camera(given);
        return given;
    }

private:
    double uniform(double low, double high) { return scenes_.uniform(low, high); }
    double decades(double low, double high) { return std::pow(10.0, uniform(low, high)); }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    std::uint32_t whole(std::uint32_t most) {
        return static_cast<std::uint32_t>(uniform(0, std::nextafter(most + 1.0, 0.0)));
    }

    // Inside, beside, or far from the cloud; towards one of its spheres.
    void set_camera(Shot &given) {
        pt_camera &camera = given.camera;
        camera = {};
        camera.struct_size = sizeof camera;
        const std::uint32_t place = whole(2);
        const double distance = place == 0 ? uniform(0, 2) : place == 1 ? uniform(2, 6) : decades(1, 6);
        const glm::dvec3 from = distance * glm::normalize(glm::dvec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
        const pt_sphere &aim = given.spheres[whole(static_cast<std::uint32_t>(given.spheres.size()) - 1)];
        for (int i = 0; i < 3; ++i) {
            camera.position[i] = from[i];
            camera.target[i] = aim.center[i] + 0.4 * aim.motion[i] + aim.radius * uniform(-0.3, 0.3);
        }
        camera.up[0] = 0.123;
        camera.up[1] = 1;
        camera.shutter_open = 0.25;
        camera.shutter_close = 0.75;
        if (chance(0.4)) {
            camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
            camera.vertical_extent = decades(-5, 3);
        } else {
            camera.vertical_fov = std::numbers::pi / 180.0 * decades(-6, 2.23);
        }
        constexpr std::array<std::uint32_t, 4> sides = {16, 64, 1080, 16384};
        given.render = render_of(sides[whole(3)], 0, 1);
        given.render.height = std::max(given.render.width * 3 / 4, rows);
        given.render.row_count = rows;
        given.render.first_row = whole(given.render.height - rows);
        given.first_column = whole(given.render.width - columns);
        given.name += camera.projection ? ", extent " + std::to_string(camera.vertical_extent)
                                        : ", fov " + std::to_string(camera.vertical_fov);
        given.name += ", " + std::to_string(given.render.width) + " wide, from " + std::to_string(distance);
    }

    TreeScenes scenes_{41};
};

TEST_F(RandomFirstHit, IsThatOfLongDouble) {
    const int scene_count = std::getenv("PT_TEST_MANY") ? 600 : 16;
    const char *const first = std::getenv("PT_TEST_FIRST_SCENE");
    RandomScenes scenes;
    std::array<Counts, 2> counts{};
    for (int i = 0; i < scene_count && !HasFailure(); ++i) {
        const Shot given = scenes.next();
        if (first && i < std::atoi(first))
            continue;
        for (const bool has_tree : {true, false}) {
            SCOPED_TRACE(std::to_string(i) + ": " + given.name + (has_tree ? ", tree" : ", list"));
            const Counts found = judge(has_tree ? context() : without_tree(), has_tree, given);
            counts[has_tree].pixels += found.pixels;
            counts[has_tree].certain += found.certain;
            counts[has_tree].spheres += found.spheres;
        }
    }
    for (const Counts &of : counts) {
        EXPECT_GT(of.certain, of.pixels * 8 / 10);
        EXPECT_GT(of.spheres, of.pixels / 3);
    }
}

// Balls in a sky, which vanished where rays started beyond the tree as soon as the camera was in the ball about it.
// With places that are whole numbers of quarters, and the camera at one, float32 and the grid have the same numbers,
// and so pictures of a tree and of a list the same bits.
TEST_F(RandomFirstHit, OfALatticeInASkyIsThatOfAList) {
    Shot shot;
    shot.materials = {{{0.7F, 0.7F, 0.7F}, {0, 0, 0}, {0, 0, 0}, 0, 0}, {{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0}};
    for (int i = 0; i < 125; ++i)
        shot.spheres.push_back(
            {{0.5 * (i % 5) - 1, 0.5 * (i / 5 % 5) - 1, 0.5 * (i / 25) - 1}, 0.125, {0, 0, 0}, 0, 0});
    for (const double sky : {16.0, 128.0}) // in the tree, and too large for it
        for (const double narrowness : {1.0, 0.25, 0.05, 1e-3, 1e-6})
            for (const bool is_parallel : {false, true}) {
                SCOPED_TRACE(std::to_string(sky) + ", " + std::to_string(narrowness) +
                             (is_parallel ? ", parallel" : ""));
                shot.spheres.resize(125);
                shot.spheres.push_back({{0, 0, 0}, sky, {0, 0, 0}, 1, 0});
                shot.camera = {};
                shot.camera.struct_size = sizeof shot.camera;
                shot.camera.position[0] = 0.25;
                shot.camera.position[2] = 1.5;
                shot.camera.target[0] = is_parallel ? 0.0 : 0.25;
                shot.camera.up[1] = 1;
                shot.camera.projection = is_parallel ? PT_PROJECTION_ORTHOGRAPHIC : PT_PROJECTION_PERSPECTIVE;
                shot.camera.vertical_extent = is_parallel ? 4.0 * narrowness : 0.0;
                shot.camera.vertical_fov = is_parallel ? 0.0 : narrowness;
                shot.camera.shutter_close = 1;
                shot.render = render_of(1440, 1080, 1);
                shot.render.first_row = 100;
                shot.render.row_count = rows;
                shot.first_column = 300;
                EXPECT_GT(judge(context(), true, shot).certain, 24U);
                EXPECT_GT(judge(without_tree(), false, shot).certain, 24U);
                if (narrowness == 1.0 && !is_parallel) {
                    EXPECT_TRUE(seen_by(context(), shot) == seen_by(without_tree(), shot));
                }
            }
}

} // namespace

} // namespace random_first_hits
