// Spheres that are given by columns, through pt.h: the bits of the same scene by structs, nothing read after the call,
// films of the one that are films of the other.
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"

#include <pt/errors.h>
#include <pt/film.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace sphere_arrays {

namespace {

constexpr std::uint32_t picture_width = 32;
constexpr std::uint32_t picture_height = 24;

// A heap of balls of a few colors, some of them in motion, under a lamp and on a floor.
struct Heap {
    static constexpr std::uint32_t ball_count = 300;

    std::vector<pt_material> materials = {{{0.8F, 0.8F, 0.8F}, {0, 0, 0}, {0, 0, 0}, 0, 0},
                                          {{0.5F, 0.5F, 0.5F}, {0.3F, 0.3F, 0.3F}, {0, 0, 0}, 30, 0},
                                          {{0, 0, 0}, {0, 0, 0}, {30, 30, 25}, 0, 0}};
    pt_sphere lamp{{2, 6, 3}, 1, {0, 0, 0}, 2, 0};
    pt_plane floor{{0, 1, 0}, 0, 0, 0};
    std::vector<float> center, radius, motion;
    std::vector<std::uint32_t> material;
    std::vector<float> color;

    Heap() {
        std::mt19937 random(7);
        const auto share = [&] { return static_cast<float>(random() >> 8) * 0x1p-24F; };
        for (std::uint32_t i = 0; i < ball_count; ++i) {
            center.insert(center.end(), {4 * share() - 2, 2 * share(), 4 * share() - 2});
            radius.push_back(0.05F + 0.1F * share());
            motion.insert(motion.end(), {0, i % 5 == 0 ? 0.25F * share() : 0, 0});
            material.push_back(i % 2);
            for (int component = 0; component < 3; ++component)
                color.push_back(static_cast<float>(random() % 3) / 2.0F);
        }
    }

    // By columns, in two arrays. Points into this object and into arrays.
    pt_scene by_columns(std::vector<pt_sphere_array> &arrays) const {
        constexpr std::uint32_t half = ball_count / 2;
        arrays.clear();
        for (const std::uint32_t first : {0U, half}) {
            pt_sphere_array array{};
            array.struct_size = sizeof array;
            array.count = half;
            array.center = {&center[3 * first], 12, PT_TYPE_FLOAT32};
            array.radius = {&radius[first], 4, PT_TYPE_FLOAT32};
            array.motion = {&motion[3 * first], 12, PT_TYPE_FLOAT32};
            array.material = {&material[first], 4, PT_TYPE_UINT32};
            array.color = {&color[3 * first], 12, PT_TYPE_FLOAT32};
            arrays.push_back(array);
        }
        pt_scene scene = scene_of(materials, {&lamp, 1}, {&floor, 1});
        scene.sphere_arrays = arrays.data();
        scene.sphere_array_count = static_cast<std::uint32_t>(arrays.size());
        return scene;
    }

    // By structs with a material each, all of which go into the vectors.
    pt_scene by_structs(std::vector<pt_material> &own_materials, std::vector<pt_sphere> &spheres) const {
        own_materials = materials;
        spheres = {lamp};
        for (std::uint32_t i = 0; i < ball_count; ++i) {
            pt_material own = materials[material[i]];
            pt_sphere sphere{};
            for (std::size_t c = 0; c < 3; ++c) {
                own.diffuse[c] *= color[3 * i + c];
                sphere.center[c] = center[3 * i + c];
                sphere.motion[c] = motion[3 * i + c];
            }
            sphere.radius = radius[i];
            sphere.material = static_cast<std::uint32_t>(own_materials.size());
            own_materials.push_back(own);
            spheres.push_back(sphere);
        }
        return scene_of(own_materials, spheres, {&floor, 1});
    }

    // All that columns point to.
    void spoil() {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        for (std::vector<float> *column : {&center, &radius, &motion, &color})
            std::vector<float>(column->size(), nan).swap(*column);
        std::vector<std::uint32_t>(material.size(), ~0U).swap(material);
    }
};

// Without a tree, in which colors are rounded (tree_render_test.cpp).
class SphereArrayRender : public ContextFixture {
protected:
    Context create_fixtures_context() override {
        return create_context([](pt_create_info &) {}, &create_without_tree);
    }

    void set_scene(const pt_scene &scene) {
        ASSERT_EQ(pt_set_scene(context(), &scene), PT_OK) << pt_last_error(context());
    }

    void set_view() {
        pt_camera camera{};
        camera.struct_size = sizeof camera;
        camera.shutter_close = 1;
        camera.position[1] = 2;
        camera.position[2] = 6;
        camera.target[1] = 0.8;
        const pt_render render = render_of(picture_width, picture_height, 4);
        ASSERT_EQ(pt_set_camera(context(), &camera), PT_OK) << pt_last_error(context());
        ASSERT_EQ(pt_set_render(context(), &render), PT_OK) << pt_last_error(context());
    }

    std::vector<float> picture() {
        accumulate(4);
        std::vector<float> pixels(3 * picture_width * picture_height);
        readback(pixels);
        return pixels;
    }

    std::vector<char> film() {
        std::uint64_t size = 0;
        EXPECT_EQ(pt_save_film(context(), nullptr, &size), PT_OK) << pt_last_error(context());
        std::vector<char> bytes(size);
        EXPECT_EQ(pt_save_film(context(), bytes.data(), &size), PT_OK) << pt_last_error(context());
        return bytes;
    }
};

TEST_F(SphereArrayRender, HasTheBitsOfStructs) {
    Heap heap;
    set_view();
    std::vector<pt_material> materials;
    std::vector<pt_sphere> spheres;
    set_scene(heap.by_structs(materials, spheres));
    const std::vector<float> expected = picture();
    const std::vector<char> expected_film = film();
    {
        std::vector<pt_sphere_array> arrays;
        set_scene(heap.by_columns(arrays));
        heap.spoil(); // nothing is read after the call
        std::memset(arrays.data(), 0xff, arrays.size() * sizeof(pt_sphere_array));
    }
    EXPECT_EQ(picture(), expected);
    EXPECT_EQ(film(), expected_film);
    // The film of structs goes on by columns.
    EXPECT_EQ(pt_add_film(context(), expected_film.data(), expected_film.size()), PT_ERROR_INCOMPATIBLE)
        << "its samples are there already";
    Heap again;
    std::vector<pt_sphere_array> arrays;
    set_scene(again.by_columns(arrays));
    EXPECT_EQ(pt_add_film(context(), expected_film.data(), expected_film.size()), PT_OK) << pt_last_error(context());
    std::vector<float> added(expected.size());
    readback(added);
    EXPECT_EQ(added, expected);
    again.color[4] = 0.75F;
    set_scene(again.by_columns(arrays));
    EXPECT_EQ(pt_add_film(context(), expected_film.data(), expected_film.size()), PT_ERROR_INCOMPATIBLE);
}

// What a refused scene had does not count: the one before is still there.
TEST_F(SphereArrayRender, KeepsTheSceneBeforeARefusedOne) {
    Heap heap;
    set_view();
    std::vector<pt_sphere_array> arrays;
    const pt_scene scene = heap.by_columns(arrays);
    set_scene(scene);
    const std::vector<float> expected = picture();
    heap.radius[200] = -1;
    EXPECT_EQ(pt_set_scene(context(), &scene), PT_ERROR_INVALID_SCENE);
    EXPECT_STREQ(pt_last_error(context()), "sphere_arrays[1].radius[50] = -1: must be > 0");
    std::vector<float> pixels(expected.size());
    readback(pixels);
    EXPECT_EQ(pixels, expected);
}

// What only pt_accumulate can say names the array too.
TEST_F(SphereArrayRender, NamesASphereThatThisCameraCannotSee) {
    Heap heap;
    set_view();
    const double center[6] = {0, -1e9 - 1, 0, 0, -1e9 + 2, 0};
    const double radius = 1e9;
    const double motion[6] = {0, 0, 0, 1e9, 0, 0};
    pt_sphere_array array{};
    array.struct_size = sizeof array;
    array.count = 2;
    array.center = {center, 24, PT_TYPE_FLOAT64};
    array.radius = {&radius, 0, PT_TYPE_FLOAT64};
    array.motion = {motion, 24, PT_TYPE_FLOAT64};
    pt_scene scene = scene_of(heap.materials, {&heap.lamp, 1}, {});
    scene.sphere_arrays = &array;
    scene.sphere_array_count = 1;
    set_scene(scene);
    const pt_accumulate_info one{sizeof one, 1, nullptr, nullptr, 0, 0, 0, nullptr, 0, 0};
    EXPECT_EQ(pt_accumulate(context(), &one), PT_ERROR_UNSUPPORTED);
    pt_broken_rule rule{};
    rule.struct_size = sizeof rule;
    ASSERT_EQ(pt_get_broken_rule(context(), 0, &rule), 1U) << pt_last_error(context());
    EXPECT_STREQ(rule.subject, "sphere_arrays");
    EXPECT_EQ(rule.index, 0);
    EXPECT_STREQ(rule.member, "motion");
    EXPECT_EQ(rule.component, 1);
}

} // namespace

} // namespace sphere_arrays
