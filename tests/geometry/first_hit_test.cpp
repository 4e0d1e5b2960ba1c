#include "tests/invariance/invariance_scene.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/half_edges.h"
#include "tests/support/render_image.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"
#include "tests/support/sized.h"

#include <cstdint>
#include <random>
#include <vector>

namespace first_hits {

namespace {

constexpr std::uint32_t picture_width = 48;
constexpr std::uint32_t picture_height = 36;

std::vector<pt_material> some_materials() {
    return {{{0.8F, 0.4F, 0.2F}, {0.1F, 0.2F, 0.3F}, {0, 0, 0}, 7, 0},
            {{0.9F, 0.1F, 0}, {0.3F, 0, 0}, {0, 0, 0}, 0, 0},
            {{0.25F, 0.5F, 0.75F}, {0, 0, 0}, {30, 20, 10}, 0, 0}};
}

InvarianceScene many() {
    InvarianceScene given{some_materials(), {}, {{{0, 0, 1}, 12, 0, 0}, {{1, 0, 0.1}, 7, 2, 0}}};
    std::mt19937 random(5);
    const auto share = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
    for (std::uint32_t i = 0; i < 400; ++i) {
        const double center[] = {6 * share() - 3, 4 * share() - 2, -4 - 6 * share()};
        const double motion = i % 2 == 0 ? share() - 0.5 : 0.0;
        given.spheres.push_back({{center[0], center[1], center[2]}, 0.05 + 0.3 * share(), {motion, 0, 0}, i % 3, 0});
    }
    given.spheres.insert(given.spheres.begin() + 100, {{0, -1e6 - 3, 0}, 1e6, {0, 0, 0}, 1, 0});
    given.camera.shutter_close = 0.5;
    return given;
}

class FirstHit : public ContextFixture {
protected:
    static pt_render picture() { return render_of(picture_width, picture_height, 2); }

    static void set(pt_context *to, const InvarianceScene &given) {
        set_picture(to, given.scene(), given.camera, picture());
    }

    static std::vector<float> read(pt_context *from, std::uint32_t quantity) {
        return values_of(from, std::size_t{picture_width} * picture_height, quantity);
    }

    template <typename Value>
    static std::vector<Value> read(pt_context *from, std::uint32_t quantity, std::uint32_t format,
                                   std::uint32_t components) {
        std::vector<Value> values(std::size_t{components} * picture_width * picture_height);
        auto target = sized<pt_image>();
        target.quantity = quantity;
        target.format = format;
        target.data = values.data();
        target.size_bytes = values.size() * sizeof(Value);
        EXPECT_EQ(pt_readback(from, &target), PT_OK) << pt_last_error(from);
        return values;
    }

    static std::vector<std::uint32_t> objects(pt_context *from) {
        return read<std::uint32_t>(from, PT_QUANTITY_OBJECT, PT_FORMAT_R32UI, 1);
    }
};

TEST_F(FirstHit, TwoDevicesAndShortSubmissionsAgree) {
    const Context hurried = create_context([](pt_create_info &info) { info.submit_milliseconds = 1; });
    const Context shared = create_context([](pt_create_info &) {}, shared_by(2, true));
    ASSERT_TRUE(hurried && shared);
    set(context(), many());
    for (pt_context *const other : {hurried.get(), shared.get()}) {
        set(other, many());
        EXPECT_EQ(objects(other), objects(context()));
        for (const std::uint32_t quantity : {PT_QUANTITY_DEPTH, PT_QUANTITY_NORMAL, PT_QUANTITY_ALBEDO})
            EXPECT_EQ(read(other, quantity), read(context(), quantity)) << quantity;
    }
}

TEST_F(FirstHit, NormalsMayBeNegativeHalves) {
    set(context(), many());
    const std::vector<float> normal = read(context(), PT_QUANTITY_NORMAL);
    const auto halves = read<std::uint16_t>(context(), PT_QUANTITY_NORMAL, PT_FORMAT_RGBA16F, 4);
    for (std::size_t i = 0; i < normal.size(); ++i) {
        const std::uint32_t half = halves[4 * (i / 3) + i % 3];
        const float magnitude = float_of_half(half & 0x7fffU);
        ASSERT_NEAR(half & 0x8000U ? -magnitude : magnitude, normal[i], 0x1p-12F) << i;
    }
}

TEST_F(FirstHit, IsNothingToSamples) {
    const Context without = create_context();
    ASSERT_TRUE(without);
    const InvarianceScene given = many();
    const std::vector<float> expected = render_image(without.get(), given.scene(), given.camera, picture(), 5);
    set(context(), given);
    const std::vector<float> depth = read(context(), PT_QUANTITY_DEPTH);
    EXPECT_EQ(stats().sample_count, 0U);
    accumulate(3);
    EXPECT_EQ(read(context(), PT_QUANTITY_DEPTH), depth);
    EXPECT_EQ(stats().sample_count, 3U);
    accumulate(2);
    EXPECT_EQ(read(context(), PT_QUANTITY_RADIANCE), expected);
}

TEST_F(FirstHit, TwinsHaveTheNumberOfTheFirst) {
    for (const std::uint32_t count : {8U, 200U}) {
        InvarianceScene given{some_materials(), {}, {{{0, 0, 1}, 12, 0, 0}, {{0, 0, 2}, 24, 1, 0}}};
        for (std::uint32_t i = 0; i < count; ++i)
            given.spheres.push_back({{0.1 * (i / 2) - 0.05 * count, 0, -9}, 0.3, {0, 0, 0}, i % 2, 0});
        set(context(), given);
        for (const std::uint32_t object : objects(context()))
            EXPECT_TRUE(object < count ? object % 2 == 0 : object == count) << object;
    }
}

// Spheres in columns are numbered after the structs. Trees store colors to a thousandth. A pixel beside a center shows
// only this sphere.
TEST_F(FirstHit, ColumnsHaveNumbersAndColors) {
    constexpr std::uint32_t side = 7;
    constexpr float radius = 0.4F;
    const pt_material grey{{0.8F, 0.8F, 0.8F}, {0, 0, 0}, {0, 0, 0}, 0, 0};
    const pt_sphere behind{{0, 0, -500}, 100, {0, 0, 0}, 0, 0};
    std::vector<float> centers;
    std::vector<float> colors;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        centers.insert(centers.end(), {static_cast<float>(i % side), static_cast<float>(i / side), -9.0F});
        colors.insert(colors.end(), {static_cast<float>(i) / (side * side), 0.5F, 1.0F});
    }
    pt_sphere_array array = array_of(side * side, {centers.data(), 12, PT_TYPE_FLOAT32}, {&radius, 0, PT_TYPE_FLOAT32});
    array.color = {colors.data(), 12, PT_TYPE_FLOAT32};
    pt_camera camera = camera_at({6, 4.5, 0}, {6, 4.5, -9});
    camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
    camera.vertical_extent = 9; // 4 pixels a unit; the lower left corner is at the origin
    for (const auto create : {&create_with_tree, &create_without_tree}) {
        const Context each = create_context([](pt_create_info &) {}, create);
        ASSERT_TRUE(each);
        set_picture(each.get(), scene_of({&grey, 1}, {&behind, 1}, {}, {&array, 1}), camera, picture());
        const std::vector<std::uint32_t> object = objects(each.get());
        const std::vector<float> albedo = read(each.get(), PT_QUANTITY_ALBEDO);
        for (std::uint32_t i = 0; i < side * side; ++i) {
            const std::size_t pixel = (picture_height - 1 - 4 * (i / side)) * picture_width + 4 * (i % side);
            EXPECT_EQ(object[pixel], 1 + i);
            for (std::size_t color = 0; color < 3; ++color)
                EXPECT_NEAR(albedo[3 * pixel + color], 0.8F * colors[3 * i + color], 1e-3F) << i;
        }
    }
}

} // namespace

} // namespace first_hits
