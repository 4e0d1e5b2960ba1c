#include "lib/film/pixel_format.h"
#include "tests/geometry/first_hit_scenes.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/image_target.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"
#include "tests/support/sized.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace first_hits {

namespace {

constexpr std::uint32_t picture_width = 48;
constexpr std::uint32_t picture_height = 36;
constexpr std::array float_quantities = {PT_QUANTITY_DEPTH, PT_QUANTITY_NORMAL, PT_QUANTITY_ALBEDO};

class FirstHit : public ContextFixture {
protected:
    static pt_render picture() { return render_of(picture_width, picture_height, 2); }

    static void set(pt_context *to, const Given &given, const pt_render &render) {
        const pt_scene scene = given.scene();
        set_picture(to, scene, given.camera, render);
    }

    static std::vector<float> read(pt_context *from, std::uint32_t quantity, std::uint32_t rows = picture_height) {
        return values_of(from, std::size_t{picture_width} * rows, quantity);
    }

    static pt_image object_target(std::span<std::uint32_t> objects) {
        auto target = sized<pt_image>();
        target.quantity = PT_QUANTITY_OBJECT;
        target.format = PT_FORMAT_R32UI;
        target.data = objects.data();
        target.size_bytes = objects.size_bytes();
        return target;
    }

    static std::vector<std::uint32_t> objects(pt_context *from, std::uint32_t rows = picture_height) {
        std::vector<std::uint32_t> values(std::size_t{picture_width} * rows, PT_NO_OBJECT - 1);
        const pt_image target = object_target(values);
        EXPECT_EQ(pt_readback(from, &target), PT_OK) << pt_last_error(from);
        return values;
    }
};

TEST_F(FirstHit, RectanglesRowsAndDevicesAgree) {
    const Given given = many(true);
    set(context(), given, picture());
    const Context hurried = create_context([](pt_create_info &info) { info.submit_milliseconds = 1; });
    ASSERT_TRUE(hurried);
    set(hurried.get(), given, picture());
    const Context shared = create_context([](pt_create_info &) {}, shared_by(2, true));
    ASSERT_TRUE(shared);
    set(shared.get(), given, picture());
    const std::vector<std::uint32_t> all_objects = objects(context());
    EXPECT_EQ(objects(shared.get()), all_objects);
    EXPECT_EQ(objects(hurried.get()), all_objects);
    constexpr std::uint32_t x = 5;
    constexpr std::uint32_t y = 3;
    constexpr std::uint32_t columns = 31;
    constexpr std::uint32_t rows = 20;
    std::vector<std::uint32_t> some_objects(std::size_t{columns} * rows);
    pt_image target = object_target(some_objects);
    set_part(target, {x, y, columns, rows});
    ASSERT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
    for (std::uint32_t row = 0; row < rows; ++row)
        EXPECT_TRUE(std::ranges::equal(std::span(some_objects).subspan(row * columns, columns),
                                       std::span(all_objects).subspan((y + row) * picture_width + x, columns)));

    for (const std::uint32_t quantity : float_quantities) {
        SCOPED_TRACE("quantity " + std::to_string(quantity));
        const std::vector<float> all = read(context(), quantity);
        EXPECT_EQ(read(shared.get(), quantity), all);
        EXPECT_EQ(read(hurried.get(), quantity), all);
    }
    const std::vector<float> normal = read(context(), PT_QUANTITY_NORMAL);
    std::vector<std::uint16_t> halves(normal.size() / 3 * 4);
    target = {};
    target.struct_size = sizeof target;
    target.quantity = PT_QUANTITY_NORMAL;
    target.format = PT_FORMAT_RGBA16F;
    target.data = halves.data();
    target.size_bytes = halves.size() * sizeof halves[0];
    ASSERT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
    for (std::size_t i = 0; i < normal.size(); ++i) {
        std::array<std::byte, 8> expected{};
        pt::write_pixels(std::array{std::abs(normal[i]), 0.0F, 0.0F}, PT_FORMAT_RGBA16F, expected.data());
        const std::uint16_t magnitude = std::bit_cast<std::array<std::uint16_t, 4>>(expected)[0];
        ASSERT_EQ(halves[4 * (i / 3) + i % 3], std::signbit(normal[i]) ? magnitude | 0x8000 : magnitude) << i;
    }

    pt_render piece = picture();
    piece.first_row = 9;
    piece.row_count = 7;
    ASSERT_EQ(pt_set_render(context(), &piece), PT_OK) << pt_last_error(context());
    EXPECT_TRUE(
        std::ranges::equal(read(context(), PT_QUANTITY_NORMAL, 7),
                           std::span(normal).subspan(std::size_t{3} * 9 * picture_width, 3 * 7 * picture_width)));
    EXPECT_TRUE(std::ranges::equal(objects(context(), 7),
                                   std::span(all_objects).subspan(std::size_t{9} * picture_width, 7 * picture_width)));
}

TEST_F(FirstHit, IsNothingToSamples) {
    for (const Given &given : {coursework(), many(true)}) {
        const Context without = create_context();
        ASSERT_TRUE(without);
        const std::vector<float> expected = render_image(without.get(), given.scene(), given.camera, picture(), 5);
        const std::uint64_t bytes = stats_of(without.get()).device_bytes;
        set(context(), given, picture());
        const std::vector<float> depth = read(context(), PT_QUANTITY_DEPTH);
        EXPECT_EQ(stats().sample_count, 0U);
        accumulate(3);
        const std::vector<float> normal = read(context(), PT_QUANTITY_NORMAL);
        EXPECT_EQ(read(context(), PT_QUANTITY_DEPTH), depth);
        EXPECT_EQ(stats().sample_count, 3U);
        accumulate(2);
        std::vector<float> image(expected.size());
        readback(image);
        EXPECT_EQ(image, expected);
        EXPECT_EQ(read(context(), PT_QUANTITY_NORMAL), normal);
        EXPECT_GT(stats().device_bytes, bytes);
    }
}

TEST_F(FirstHit, FollowsTheSetters) {
    Given given = coursework();
    set(context(), given, picture());
    const std::vector<std::uint32_t> before = objects(context());
    given.camera.position[0] = 1.5;
    ASSERT_EQ(pt_set_camera(context(), &given.camera), PT_OK);
    const std::vector<std::uint32_t> moved = objects(context());
    EXPECT_NE(moved, before);
    set(context(), many(false), picture());
    const std::vector<std::uint32_t> other = objects(context());
    given.camera.position[0] = 0;
    set(context(), given, picture());
    EXPECT_EQ(objects(context()), before);
    set(context(), many(false), picture());
    EXPECT_EQ(objects(context()), other);
}

TEST_F(FirstHit, TwinsHaveTheNumberOfTheFirst) {
    for (const std::uint32_t count : {8U, 200U}) {
        Given given;
        given.materials = some_materials();
        for (std::uint32_t i = 0; i < count; ++i)
            given.spheres.push_back({{0.1 * (i / 2) - 0.05 * count, 0, -9}, 0.3, {0, 0, 0}, i % 2, 0});
        given.planes = {{{0, 0, 1}, 12, 0, 0}, {{0, 0, 2}, 24, 1, 0}};
        set(context(), given, picture());
        for (const std::uint32_t object : objects(context()))
            EXPECT_TRUE(object < count ? object % 2 == 0 : object == count) << object;
    }
}

// Spheres in columns are numbered after the structs. Trees store colors to a thousandth.
TEST_F(FirstHit, ColumnsHaveNumbersAndColors) {
    Given given;
    given.materials = {{{0.8F, 0.8F, 0.8F}, {0, 0, 0}, {0, 0, 0}, 0, 0}};
    given.spheres = {{{0, 0, -500}, 100, {0, 0, 0}, 0, 0}};
    for (const std::uint32_t side : {3U, 7U}) {
        const std::uint32_t count = side * side;
        std::vector<float> centers;
        std::vector<float> colors;
        for (std::uint32_t i = 0; i < count; ++i) {
            const float step = 8.0F / static_cast<float>(side);
            centers.insert(centers.end(), {step * (static_cast<float>(i % side) + 0.5F) - 4.0F,
                                           step * (static_cast<float>(i / side) + 0.5F) - 4.0F, -9.0F});
            colors.insert(colors.end(), {static_cast<float>(i) / static_cast<float>(count), 0.5F, 1.0F});
        }
        const float radius = 3.5F / static_cast<float>(side);
        pt_sphere_array array = array_of(count, {centers.data(), 12, PT_TYPE_FLOAT32}, {&radius, 0, PT_TYPE_FLOAT32});
        array.color = {colors.data(), 12, PT_TYPE_FLOAT32};
        pt_scene scene = given.scene();
        scene.sphere_arrays = &array;
        scene.sphere_array_count = 1;
        set(context(), given, picture());
        ASSERT_EQ(pt_set_scene(context(), &scene), PT_OK) << pt_last_error(context());
        const std::vector<std::uint32_t> object = objects(context());
        const std::vector<float> albedo = read(context(), PT_QUANTITY_ALBEDO);
        std::vector<bool> seen(count);
        for (std::size_t pixel = 1; pixel + 1 < object.size(); ++pixel) {
            const std::uint32_t number = object[pixel];
            const bool is_within = object[pixel - 1] == number && object[pixel + 1] == number &&
                                   pixel >= picture_width && pixel + picture_width < object.size() &&
                                   object[pixel - picture_width] == number && object[pixel + picture_width] == number;
            if (number == 0 || number == PT_NO_OBJECT || !is_within)
                continue;
            ASSERT_LE(number, count);
            seen[number - 1] = true;
            for (std::size_t i = 0; i < 3; ++i)
                EXPECT_NEAR(albedo[3 * pixel + i], 0.8F * colors[3 * (number - 1) + i], 1e-3F) << number;
        }
        EXPECT_GT(std::ranges::count(seen, true), static_cast<std::ptrdiff_t>(count / 2));
    }
}

TEST_F(FirstHit, NothingIsInfinitelyFar) {
    const Given given;
    set(context(), given, picture());
    for (const float depth : read(context(), PT_QUANTITY_DEPTH))
        ASSERT_EQ(depth, std::numeric_limits<float>::infinity());
    for (const std::uint32_t object : objects(context()))
        ASSERT_EQ(object, PT_NO_OBJECT);
    for (const std::uint32_t quantity : {PT_QUANTITY_NORMAL, PT_QUANTITY_ALBEDO})
        for (const float value : read(context(), quantity))
            ASSERT_EQ(value, 0.0F);
}

TEST_F(FirstHit, NeedsWhatItLooksAt) {
    std::vector<float> values(std::size_t{3} * picture_width * picture_height);
    const pt_image target = image_target(values, PT_QUANTITY_DEPTH);
    EXPECT_EQ(pt_readback(context(), &target), PT_ERROR_INVALID_STATE);
    EXPECT_STREQ(pt_last_error(context()), "no scene: call pt_set_scene first");
    set(context(), coursework(), picture());
    EXPECT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
}

} // namespace

} // namespace first_hits
