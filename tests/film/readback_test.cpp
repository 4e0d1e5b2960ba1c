#include "lib/film/pixel_format.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/image_target.h"
#include "tests/support/render_image.h"
#include "tests/support/shared_context.h"
#include "tests/support/sized.h"

#include <pt/map.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <tuple>

namespace {

constexpr std::uint32_t whole_width = 61;
constexpr std::uint32_t first_row = 7;
constexpr std::uint32_t whole_height = 40;
constexpr std::byte untouched{0xa5};

class ReadbackTest : public ContextFixture {
protected:
    static void render(pt_context *context) {
        const CourseworkScene coursework;
        pt_render settings = render_of(whole_width, whole_height + 2 * first_row, 3);
        settings.first_row = first_row;
        settings.row_count = whole_height;
        settings.flags = PT_RENDER_COVERAGE;
        render_image(context, coursework.scene(), CourseworkScene::camera(), settings, 17);
    }

    template <typename Test>
    void on_each_path(const Test &test) {
        for (const auto &[devices, like_gpus] : {std::tuple(1U, false), {1U, true}, {2U, true}}) {
            SCOPED_TRACE("devices: " + std::to_string(devices) + ", used as GPUs: " + std::to_string(like_gpus));
            const Context context = create_context([](pt_create_info &) {}, shared_by(devices, like_gpus));
            ASSERT_TRUE(context);
            render(context.get());
            test(context.get());
        }
    }

    static std::vector<float> whole(pt_context *context, std::uint32_t quantity = PT_QUANTITY_RADIANCE) {
        return values_of(context, std::size_t{whole_width} * whole_height, quantity);
    }
};

TEST_F(ReadbackTest, RectanglesAndFormatsArePartsOfTheImage) {
    on_each_path([](pt_context *context) {
        for (const std::uint32_t quantity : {PT_QUANTITY_RADIANCE, PT_QUANTITY_STANDARD_ERROR, PT_QUANTITY_DEPTH,
                                             PT_QUANTITY_ALBEDO, PT_QUANTITY_COVERAGE}) {
            const std::vector<float> all = whole(context, quantity);
            ASSERT_GT(*std::ranges::max_element(all), 0.0F);
            for (const std::uint32_t format : {PT_FORMAT_RGB32F, PT_FORMAT_RGBA32F, PT_FORMAT_RGBA16F})
                for (const auto &[x, y, width, height, gap] : {std::tuple(0U, 0U, 0U, 0U, 0U),
                                                               {0U, 0U, whole_width, whole_height, 4U},
                                                               {60U, 39U, 1U, 1U, 0U},
                                                               {13U, 5U, 30U, 20U, 12U},
                                                               {0U, 10U, whole_width, 3U, 0U},
                                                               {2U, 0U, 1U, whole_height, 0U}}) {
                    SCOPED_TRACE("quantity " + std::to_string(quantity) + ", format " + std::to_string(format) +
                                 ", column " + std::to_string(x));
                    const std::uint32_t columns = width == 0 ? whole_width : width;
                    const std::uint32_t rows = height == 0 ? whole_height : height;
                    const std::size_t row = std::size_t{columns} * pt::pixel_bytes(format);
                    std::vector<std::byte> expected(rows * (row + gap) - gap, untouched);
                    std::vector<std::byte> found = expected;
                    for (std::uint32_t i = 0; i < rows; ++i)
                        pt::write_pixels(std::span(all).subspan(3 * ((y + i) * whole_width + x), 3 * columns), format,
                                         &expected[i * (row + gap)]);
                    auto image = sized<pt_image>();
                    image.quantity = quantity;
                    set_part(image, {x, y, width, height});
                    image.format = format;
                    void *pixels = nullptr;
                    std::uint64_t size = 0;
                    ASSERT_EQ(pt_map_image(context, &image, &pixels, &size), PT_OK) << pt_last_error(context);
                    image.data = found.data();
                    image.size_bytes = found.size();
                    image.row_bytes = row + gap;
                    ASSERT_EQ(pt_readback(context, &image), PT_OK) << pt_last_error(context);
                    ASSERT_TRUE(found == expected);
                    ASSERT_EQ(size, rows * row);
                    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(pixels) % 16, 0U);
                    EXPECT_TRUE(gap > 0 || std::memcmp(pixels, expected.data(), size) == 0) << "mapped";
                }
        }
    });
}

TEST_F(ReadbackTest, AMappedImageStaysWhileTheNextIsRendered) {
    on_each_path([](pt_context *context) {
        const std::vector<float> before = whole(context);
        auto image = sized<pt_image>();
        void *pixels = nullptr;
        ASSERT_EQ(pt_map_image(context, &image, &pixels, nullptr), PT_OK) << pt_last_error(context);
        const pt_camera camera = CourseworkScene::camera();
        ASSERT_EQ(pt_set_camera(context, &camera), PT_OK);
        accumulate_on(context, 3);
        EXPECT_NE(whole(context), before);
        EXPECT_EQ(std::memcmp(pixels, before.data(), before.size() * sizeof(float)), 0);
        void *again = nullptr;
        ASSERT_EQ(pt_map_image(context, &image, &again, nullptr), PT_OK) << pt_last_error(context);
        EXPECT_EQ(again, pixels) << "the memory is kept";
        EXPECT_NE(std::memcmp(pixels, before.data(), before.size() * sizeof(float)), 0);
    });
}

TEST_F(ReadbackTest, MappedImagesHaveNoMemoryOfTheCallers) {
    render(context());
    std::vector<float> values(std::size_t{3} * whole_width * whole_height);
    const pt_image target = image_target(values, PT_QUANTITY_RADIANCE, std::uint64_t{12} * whole_width);
    void *const nothing = &values;
    void *pixels = nothing;
    EXPECT_EQ(pt_map_image(context(), &target, &pixels, nullptr), PT_ERROR_INVALID_ARGUMENT);
    const std::string message = pt_last_error(context());
    for (const char *const rule : {"image.data = ", ": must be NULL: the memory is the library's",
                                   "image.size_bytes = 29280: must be 0: the memory is the library's",
                                   "image.row_bytes = 732: must be 0: rows have no gaps"})
        EXPECT_NE(message.find(rule), std::string::npos) << message;
    EXPECT_EQ(pixels, nothing);
    auto image = sized<pt_image>();
    EXPECT_EQ(pt_map_image(context(), &image, nullptr, nullptr), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(pt_last_error(context()), "data = NULL: must not be NULL");
}

} // namespace
