// PT_TEST_MANY renders 600 scenes. PT_TEST_FIRST_SCENE is the first scene's number.
#include "lib/view/camera_rules.h"
#include "lib/view/view.h"
#include "tests/geometry/tree_scenes.h"
#include "tests/invariance/invariance_scene.h"
#include "tests/support/checked_scene_of.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/first_hit_reference.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"
#include "tests/support/sized.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace random_first_hits {

namespace {

using namespace first_hits;

struct Shot : InvarianceScene {
    std::string name;
    pt_render render{};
    std::uint32_t first_column = 0;
};

constexpr std::uint32_t columns = 16;
constexpr std::uint32_t rows = 2;
constexpr std::uint32_t skipped_rows = 1; // of the rendered rows
constexpr std::uint32_t lattice_size = 16;

struct Pixels {
    std::vector<std::uint32_t> objects;
    std::vector<float> depths, normals, albedos;
};

struct Counts {
    std::uint32_t pixels = 0;
    std::uint32_t certain = 0;
    std::uint32_t spheres = 0;
    std::uint32_t means = 0;
};

glm::dvec3 albedo_of(const Shot &given, std::uint32_t object) {
    if (object == PT_NO_OBJECT)
        return glm::dvec3(0.0);
    const std::size_t plane = object - given.spheres.size();
    const pt_material &material =
        given.materials[object < given.spheres.size() ? given.spheres[object].material : given.planes[plane].material];
    glm::dvec3 albedo;
    for (int i = 0; i < 3; ++i)
        albedo[i] = std::min(double{material.diffuse[i]} + double{material.specular[i]}, 1.0);
    return albedo;
}

struct Means {
    Vector normal{0.0L};
    Real normal_tolerance = 0.0L;
    glm::dvec3 albedo{0.0};
};

std::optional<Means> means_of(const Shot &given, const pt_scene &scene, const View &view, std::uint32_t column,
                              std::uint32_t row) {
    Means means;
    for (std::uint32_t i = 0; i < lattice_size; ++i) {
        const auto place = [&](std::uint32_t factor) { return (factor * i % lattice_size + 0.5L) / lattice_size; };
        const std::optional<Meeting> met = first_met(scene, view, view.ray(column, row, place(1), place(3), place(5)));
        if (!met)
            return std::nullopt;
        means.normal += met->normal / Real{lattice_size};
        means.normal_tolerance += met->normal_tolerance / lattice_size;
        means.albedo += albedo_of(given, met->object) / double{lattice_size};
    }
    return means;
}

class RandomFirstHit : public ContextFixture {
protected:
    static void read(pt_context *from, const Shot &given, std::uint32_t quantity, std::uint32_t format, void *data,
                     std::size_t bytes) {
        auto target = sized<pt_image>();
        target.quantity = quantity;
        target.format = format;
        target.data = data;
        target.size_bytes = bytes;
        set_part(target, {given.first_column, skipped_rows, columns, rows});
        ASSERT_EQ(pt_readback(from, &target), PT_OK) << pt_last_error(from);
    }

    static Pixels seen_by(pt_context *context, const Shot &given) {
        const pt_scene scene = given.scene();
        Pixels pixels{std::vector<std::uint32_t>(columns * rows), {}, {}, {}};
        set_picture(context, scene, given.camera, given.render);
        read(context, given, PT_QUANTITY_OBJECT, PT_FORMAT_R32UI, pixels.objects.data(), 4 * pixels.objects.size());
        for (const auto &[quantity, values] : {std::pair{PT_QUANTITY_DEPTH, &pixels.depths},
                                               {PT_QUANTITY_NORMAL, &pixels.normals},
                                               {PT_QUANTITY_ALBEDO, &pixels.albedos}}) {
            values->resize(3 * columns * rows);
            read(context, given, quantity, PT_FORMAT_RGB32F, values->data(), 4 * values->size());
        }
        return pixels;
    }

    static bool judge_means(const Pixels &pixels, std::uint32_t pixel, const Shot &given, const pt_scene &scene,
                            const View &view) {
        const std::optional<Means> means = means_of(given, scene, view, given.first_column + pixel % columns,
                                                    given.render.first_row + skipped_rows + pixel / columns);
        if (!means)
            return false;
        // This is the error of sums of 16 numbers up to 1. Albedos add a dozen roundings.
        const double of_sum = 16.0 * static_cast<double>(rounding);
        for (int i = 0; i < 3; ++i) {
            const std::size_t place = 3 * pixel + static_cast<std::size_t>(i);
            EXPECT_NEAR(pixels.normals[place], static_cast<double>(means->normal[i]),
                        static_cast<double>(means->normal_tolerance) + of_sum);
            EXPECT_NEAR(pixels.albedos[place], means->albedo[i], 2.0 * of_sum);
        }
        return true;
    }

    static void judge(pt_context *context, bool has_tree, const Shot &given, Counts &counts) {
        const Pixels pixels = seen_by(context, given);
        const pt_scene scene = given.scene();
        const pt::PreparedScene prepared = prepared_scene_of(checked_scene_of(scene), has_tree ? 1 : UINT32_MAX);
        View view(given.camera, given.render);
        view.start_distance =
            pt::view_of(prepared, pt::validated_camera(given.camera), pt::validated_render(given.render))
                .start_distance;
        view.tree_step = prepared.tree ? prepared.tree->grid().step : 0.0;
        for (std::uint32_t pixel = 0; pixel < columns * rows; ++pixel) {
            const std::uint32_t column = given.first_column + pixel % columns;
            const std::uint32_t row = given.render.first_row + skipped_rows + pixel / columns;
            SCOPED_TRACE(std::to_string(column) + ", " + std::to_string(row));
            counts.means += pixel % 8 == 0 && judge_means(pixels, pixel, given, scene, view) ? 1 : 0;
            const Ray ray = view.ray(column, row, 0.5L, 0.5L, 0.5L);
            const std::optional<Meeting> met = first_met(scene, view, ray);
            ++counts.pixels;
            if (!met)
                continue;
            ++counts.certain;
            counts.spheres += met->object < given.spheres.size() ? 1 : 0;
            EXPECT_EQ(pixels.objects[pixel], met->object);
            EXPECT_EQ(pixels.depths[3 * pixel + 1], pixels.depths[3 * pixel]);
            EXPECT_EQ(pixels.depths[3 * pixel + 2], pixels.depths[3 * pixel]);
            const Real depth = met->distance * glm::dot(ray.direction, view.forward);
            // The cosine to the axis and the product add 8 rounding errors.
            const Real tolerance = met->tolerance + 8.0L * rounding * met->distance;
            if (met->object == PT_NO_OBJECT)
                EXPECT_EQ(pixels.depths[3 * pixel], std::numeric_limits<float>::infinity());
            else
                EXPECT_NEAR(pixels.depths[3 * pixel], static_cast<double>(depth), static_cast<double>(tolerance));
            if (testing::Test::HasFailure())
                break;
        }
    }
};

class RandomScenes {
public:
    Shot next() {
        const pt::Scene scene = scenes_.next(2000);
        Shot given;
        given.name = scenes_.kind() + ", " + std::to_string(scene.spheres.size()) + " spheres";
        for (const pt::Material &material : scene.materials)
            given.materials.push_back({{material.diffuse.r, material.diffuse.g, material.diffuse.b},
                                       {material.specular.r, material.specular.g, material.specular.b},
                                       {material.emission.r, 0, 0},
                                       0,
                                       0});
        given.materials[1].specular[0] = 0.5F;
        if (chance(0.3))
            given.materials[2].flags = PT_MATERIAL_HIDDEN_FROM_CAMERA;
        given.spheres = caller_spheres(scene.spheres);
        for (const pt::Plane &plane : scene.planes)
            given.planes.push_back({{plane.normal.x, plane.normal.y, plane.normal.z}, plane.offset, 1, 0});
        if (chance(0.4))
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

    void set_camera(Shot &given) {
        pt_camera &camera = given.camera;
        camera = {};
        camera.struct_size = sizeof camera;
        const std::uint32_t place = whole(2);
        const double distance = place == 0 ? uniform(0, 2) : place == 1 ? decades(0.3, 2.3) : decades(1, 6);
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
            camera.vertical_fov = std::numbers::pi / 180.0 * (chance(0.5) ? uniform(1, 170) : decades(-6, 0));
            if (chance(0.3)) { // First hits use the pinhole at the lens's center.
                camera.aperture = 0.5;
                camera.focus = 1.0;
            }
        }
        constexpr std::array<std::uint32_t, 4> sides = {16, 64, 1080, 16384};
        given.render = render_of(sides[whole(3)], 0, 1);
        given.render.height = given.render.width * 3 / 4;
        given.render.row_count = skipped_rows + rows;
        const bool is_middle = chance(0.5); // The target is in the middle.
        const std::uint32_t last_row = given.render.height - given.render.row_count;
        const std::uint32_t last_column = given.render.width - columns;
        given.render.first_row = is_middle ? last_row / 2 : whole(last_row);
        given.first_column = is_middle ? last_column / 2 : whole(last_column);
        given.name += camera.projection ? ", extent " + std::to_string(camera.vertical_extent)
                                        : ", fov " + std::to_string(camera.vertical_fov);
        given.name += ", " + std::to_string(given.render.width) + " wide, from " + std::to_string(distance);
    }

    TreeScenes scenes_{41};
};

TEST_F(RandomFirstHit, IsThatOfLongDouble) {
    const int scene_count = std::getenv("PT_TEST_MANY") ? 600 : 32;
    const char *const first = std::getenv("PT_TEST_FIRST_SCENE");
    const std::array contexts{create_context([](pt_create_info &) {}, &create_without_tree),
                              create_context([](pt_create_info &) {}, &create_with_tree)};
    ASSERT_TRUE(contexts[0] && contexts[1]);
    RandomScenes scenes;
    std::array<Counts, 2> counts{};
    for (int i = 0; i < scene_count && !HasFailure(); ++i) {
        const Shot given = scenes.next();
        if (first && i < std::atoi(first))
            continue;
        for (const bool has_tree : {true, false}) {
            SCOPED_TRACE(std::to_string(i) + ": " + given.name + (has_tree ? ", tree" : ", list"));
            judge(contexts[has_tree].get(), has_tree, given, counts[has_tree]);
        }
    }
    for (const Counts &of : counts) {
        EXPECT_GT(of.certain, of.pixels * 8 / 10);
        EXPECT_GT(of.spheres, of.pixels / 3);
        EXPECT_GT(of.means, of.pixels / 16);
    }
}

} // namespace

} // namespace random_first_hits
