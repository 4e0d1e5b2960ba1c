// The rules of render settings and their defaults.
#include "lib/base/error.h"
#include "lib/scene/render_settings.h"

#include <gtest/gtest.h>

#include <string>

namespace {

pt_render valid_render() {
    pt_render render{};
    render.struct_size = sizeof render;
    render.width = 640;
    render.height = 480;
    return render;
}

// The message of the error, or "accepted".
std::string message(const pt_render &render) {
    try {
        pt::validated_render(render);
    } catch (const pt::Error &error) {
        EXPECT_EQ(error.code(), PT_ERROR_INVALID_ARGUMENT);
        return error.what();
    }
    return "accepted";
}

struct RenderCase {
    const char *name;
    void (*spoil)(pt_render &render);
    const char *message;
};

void PrintTo(const RenderCase &test_case, std::ostream *out) {
    *out << test_case.name;
}

class BrokenRender : public testing::TestWithParam<RenderCase> {};

TEST_P(BrokenRender, IsRefusedWithMessage) {
    pt_render render = valid_render();
    ASSERT_EQ(message(render), "accepted");
    GetParam().spoil(render);
    EXPECT_EQ(message(render), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    Rules, BrokenRender,
    testing::Values(RenderCase{"NoWidth", [](pt_render &r) { r.width = 0; }, "render.width = 0: must be >= 1"},
                    RenderCase{"NoHeight", [](pt_render &r) { r.height = 0; }, "render.height = 0: must be >= 1"},
                    RenderCase{"NoPixels", [](pt_render &r) { r.width = r.height = 0; },
                               "render.width = 0: must be >= 1\nrender.height = 0: must be >= 1"},
                    RenderCase{"TooManyPixels", [](pt_render &r) { r.width = r.height = 65536; },
                               "render.width * height = 4294967296: must be <= 4294967295"},
                    RenderCase{"PixelsThatWrapAround", [](pt_render &r) { r.width = r.height = 4294967295U; },
                               "render.width * height = 18446744065119617025: must be <= 4294967295"},
                    RenderCase{"PathsTooLong", [](pt_render &r) { r.max_path_length = 1025; },
                               "render.max_path_length = 1025: must be <= 1024"},
                    RenderCase{"EstimatorUnknown", [](pt_render &r) { r.estimator = 6; },
                               "render.estimator = 6: must be a PT_ESTIMATOR_* of pt.h"},
                    RenderCase{"SamplerUnknown", [](pt_render &r) { r.sampler = 5; },
                               "render.sampler = 5: must be a PT_SAMPLER_* of pt.h"},
                    RenderCase{"FirstRowBelowTheImage", [](pt_render &r) { r.first_row = 480; },
                               "render.first_row = 480: must be < height"},
                    RenderCase{"RowsBelowTheImage", [](pt_render &r) { r.first_row = 479, r.row_count = 2; },
                               "render.first_row + row_count = 481: must be <= height"},
                    RenderCase{"ReservedUsed", [](pt_render &r) { r.reserved = 1; }, "render.reserved = 1: must be 0"}),
    [](const auto &instance) { return std::string(instance.param.name); });

TEST(RenderSettings, HaveTheDefaultsOfTheHeader) {
    const pt::RenderSettings settings = pt::validated_render(valid_render());
    EXPECT_EQ(settings.width, 640U);
    EXPECT_EQ(settings.height, 480U);
    EXPECT_EQ(settings.max_path_length, 6U);
    EXPECT_EQ(settings.seed, 0U);
    EXPECT_EQ(settings.first_sample, 0U);
    EXPECT_EQ(settings.estimator, uint32_t{PT_ESTIMATOR_MIS});
    EXPECT_EQ(settings.sampler, uint32_t{PT_SAMPLER_SOBOL});
    EXPECT_EQ(settings.first_row, 0U);
    EXPECT_EQ(settings.row_count, 480U);
}

TEST(RenderSettings, TakeWhatIsSet) {
    const pt_render render{sizeof(pt_render), 3, 7, 1, 0x123456789abcdef0U, 4294967295U, PT_ESTIMATOR_UNIFORM,
                           PT_SAMPLER_HALTON, 0, 2, 4};
    const pt::RenderSettings settings = pt::validated_render(render);
    EXPECT_EQ(settings.width, 3U);
    EXPECT_EQ(settings.height, 7U);
    EXPECT_EQ(settings.max_path_length, 1U);
    EXPECT_EQ(settings.seed, 0x123456789abcdef0U);
    EXPECT_EQ(settings.first_sample, 4294967295U);
    EXPECT_EQ(settings.estimator, uint32_t{PT_ESTIMATOR_UNIFORM});
    EXPECT_EQ(settings.sampler, uint32_t{PT_SAMPLER_HALTON});
    EXPECT_EQ(settings.first_row, 2U);
    EXPECT_EQ(settings.row_count, 4U);
}

TEST(RenderSettings, AcceptExtremes) {
    pt_render render = valid_render();
    render.width = render.height = 1;
    render.max_path_length = 1024;
    render.estimator = PT_ESTIMATOR_MIS;
    EXPECT_EQ(message(render), "accepted");
    render.width = 65535;
    render.height = 65537;
    EXPECT_EQ(message(render), "accepted");
    render.width = 4294967295U;
    render.height = 1;
    EXPECT_EQ(message(render), "accepted");
}

} // namespace
