// What camera rays meet first, through pt.h: depth, normal, albedo and object of every pixel against long double, and
// that reading them does not affect the samples. Run alone with --gtest_filter=FirstHit*.
#include "lib/film/pixel_format.h"
#include "tests/device/first_hit_scenes.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/first_hit_reference.h"
#include "tests/support/image_target.h"
#include "tests/support/render_image.h"
#include "tests/support/shared_context.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace first_hits {

namespace {

constexpr std::uint32_t picture_width = 48;
constexpr std::uint32_t picture_height = 36;
constexpr std::uint32_t lattice_size = 16;
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
        pt_image target{};
        target.struct_size = sizeof target;
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

glm::dvec3 albedo_of(const Given &given, std::uint32_t object) {
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

// The mean over the rays of a pixel; nothing if one of them is uncertain.
struct Means {
    Vector normal{0.0L};
    Real normal_tolerance = 0.0L;
    glm::dvec3 albedo{0.0};
};

std::optional<Means> means_of(const Given &given, const pt_scene &scene, const View &view, std::uint32_t column,
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

TEST_F(FirstHit, IsWhatLongDoubleFinds) {
    for (const auto &[name, given] : cases()) {
        SCOPED_TRACE(name);
        const pt_scene scene = given.scene();
        set(context(), given, picture());
        const std::vector<float> depth = read(context(), PT_QUANTITY_DEPTH);
        const std::vector<float> normal = read(context(), PT_QUANTITY_NORMAL);
        const std::vector<float> albedo = read(context(), PT_QUANTITY_ALBEDO);
        const std::vector<std::uint32_t> object = objects(context());
        View view(given.camera, picture());
        view.start_distance = given.start_distance;
        std::size_t pixels = 0;
        std::size_t certain = 0;
        std::size_t certain_means = 0;
        for (std::uint32_t pixel = 0; pixel < picture_width * picture_height;
             pixel += 5) { // long double takes its time
            ++pixels;
            const std::uint32_t column = pixel % picture_width;
            const std::uint32_t row = pixel / picture_width;
            SCOPED_TRACE("pixel " + std::to_string(column) + ", " + std::to_string(row));
            const Ray centre = view.ray(column, row, 0.5L, 0.5L, 0.5L);
            if (const std::optional<Meeting> met = first_met(scene, view, centre)) {
                ++certain;
                ASSERT_EQ(object[pixel], met->object);
                // The cosine to the axis, and the product, are off by 8 roundings.
                const Real cosine = glm::dot(centre.direction, view.forward);
                const Real exact = met->distance * cosine;
                const Real tolerance = met->tolerance + 8.0L * rounding * met->distance;
                if (met->object == PT_NO_OBJECT)
                    ASSERT_EQ(depth[3 * pixel], std::numeric_limits<float>::infinity());
                else
                    ASSERT_NEAR(depth[3 * pixel], static_cast<double>(exact), static_cast<double>(tolerance));
                ASSERT_EQ(depth[3 * pixel + 1], depth[3 * pixel]);
                ASSERT_EQ(depth[3 * pixel + 2], depth[3 * pixel]);
            }
            if (const std::optional<Means> means = means_of(given, scene, view, column, row)) {
                ++certain_means;
                // Sums of 16 numbers of at most 1; albedos are products with pi and a share of it, and have been
                // divided by those: a dozen roundings.
                const double of_sum = 16.0 * static_cast<double>(rounding);
                for (int i = 0; i < 3; ++i) {
                    ASSERT_NEAR(normal[3 * pixel + static_cast<std::uint32_t>(i)],
                                static_cast<double>(means->normal[i]),
                                static_cast<double>(means->normal_tolerance) + of_sum);
                    ASSERT_NEAR(albedo[3 * pixel + static_cast<std::uint32_t>(i)], means->albedo[i], 2.0 * of_sum);
                }
            }
        }
        // What is uncertain is the edges of few pixels, as float32 knows them well.
        EXPECT_GE(certain, pixels * 98 / 100);
        EXPECT_GE(certain_means, pixels * 95 / 100);
    }
}

// A pixel's bits do not depend on what is read besides it, nor on which rows are rendered, nor on how long submissions
// are, nor on how many devices there are; and the other formats have the same numbers.
TEST_F(FirstHit, RectanglesRowsFormatsAndDevicesAgree) {
    const Given given = many(true);
    set(context(), given, picture());
    const Context hurried = create_context([](pt_create_info &info) { info.submit_milliseconds = 1; });
    ASSERT_TRUE(hurried); // pieces of some hundred pixels
    set(hurried.get(), given, picture());
    const Context shared = create_context([](pt_create_info &) {},
                                          [](auto *info, auto **made) { return create_shared(2, *info, made, true); });
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
    target.x = x;
    target.y = y;
    target.width = columns;
    target.height = rows;
    ASSERT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
    for (std::uint32_t row = 0; row < rows; ++row)
        EXPECT_TRUE(std::ranges::equal(std::span(some_objects).subspan(row * columns, columns),
                                       std::span(all_objects).subspan((y + row) * picture_width + x, columns)));

    for (const std::uint32_t quantity : float_quantities) {
        SCOPED_TRACE("quantity " + std::to_string(quantity));
        const std::vector<float> all = read(context(), quantity);
        EXPECT_EQ(read(shared.get(), quantity), all);
        EXPECT_EQ(read(hurried.get(), quantity), all);
        for (const std::uint32_t format : {PT_FORMAT_RGB32F, PT_FORMAT_RGBA32F, PT_FORMAT_RGBA16F}) {
            SCOPED_TRACE("format " + std::to_string(format));
            const std::size_t row_bytes = std::size_t{columns} * pt::pixel_bytes(format) + 8;
            std::vector<std::byte> found(rows * row_bytes, std::byte{0xa5});
            std::vector<std::byte> expected = found;
            for (std::uint32_t row = 0; row < rows; ++row)
                for (std::uint32_t column = 0; column < columns; ++column) {
                    std::array<float, 3> pixel{};
                    std::copy_n(&all[3 * ((y + row) * picture_width + x + column)], 3, pixel.begin());
                    std::byte *const to = &expected[row * row_bytes + column * pt::pixel_bytes(format)];
                    std::array<float, 3> magnitudes{};
                    std::ranges::transform(pixel, magnitudes.begin(), [](float value) { return std::abs(value); });
                    pt::write_pixels(format == PT_FORMAT_RGBA16F ? magnitudes : pixel, format, to);
                    for (std::size_t i = 0; format == PT_FORMAT_RGBA16F && i < 3; ++i)
                        if (std::signbit(pixel[i]))
                            to[2 * i + 1] |= std::byte{0x80};
                }
            target.quantity = quantity;
            target.format = format;
            target.data = found.data();
            target.size_bytes = found.size();
            target.row_bytes = row_bytes;
            ASSERT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
            EXPECT_EQ(found, expected);
        }
    }

    const std::vector<float> normal = read(context(), PT_QUANTITY_NORMAL);
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

// They need no sample, take none, and samples that are taken around them have the bits that they have without.
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
        EXPECT_GT(stats().device_bytes, bytes); // memory is taken when they are asked for
    }
}

// Another camera, scene or size is seen at once, whether it takes another kernel or not.
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

// Of surfaces that are one the first has the number, be they in a tree or not.
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

// Spheres by columns are counted after those of structs, and have their colors: in a tree held to a thousandth.
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
        pt_sphere_array array{};
        array.struct_size = sizeof array;
        array.count = count;
        array.center = {centers.data(), 12, PT_TYPE_FLOAT32};
        array.radius = {&radius, 0, PT_TYPE_FLOAT32};
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
