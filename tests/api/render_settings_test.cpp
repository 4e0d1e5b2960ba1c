#include "lib/scene/render_settings.h"

#include "tests/geometry/refusals.h"
#include "tests/support/sized.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace {

pt_render valid_render() {
    auto render = sized<pt_render>();
    render.width = 640;
    render.height = 480;
    return render;
}

std::string render_outcome(const pt_render &render) {
    return outcome_of(PT_ERROR_INVALID_ARGUMENT, [&] { pt::validated_render(render); });
}

TEST(RenderSettings, BrokenRulesAreNamed) {
    expect_refusals<pt_render>(valid_render(), render_outcome,
                               {{[](pt_render &r) {
                                     r.width = r.height = 0;
                                     r.max_path_length = 1025;
                                     r.estimator = 6;
                                     r.sampler = 5;
                                     r.flags = 2;
                                 },
                                 "render.width = 0: must be >= 1\n"
                                 "render.height = 0: must be >= 1\n"
                                 "render.max_path_length = 1025: must be <= 1024\n"
                                 "render.estimator = 6: must be a PT_ESTIMATOR_* of pt.h\n"
                                 "render.sampler = 5: must be a PT_SAMPLER_* of pt.h\n"
                                 "render.flags = 2: must have only bits PT_RENDER_* of pt.h"},
                                {[](pt_render &r) { r.width = r.height = 65536; },
                                 "render.width * height = 4294967296: must be <= 4294967295"},
                                {[](pt_render &r) { r.width = r.height = 4294967295U; },
                                 "render.width * height = 18446744065119617025: must be <= 4294967295"},
                                {[](pt_render &r) { r.first_row = 480; }, "render.first_row = 480: must be < height"},
                                {[](pt_render &r) { r.first_row = 479, r.row_count = 2; },
                                 "render.first_row + row_count = 481: must be <= height"}});
}

TEST(RenderSettings, HaveTheDefaultsOfTheHeader) {
    const pt::RenderSettings settings = pt::validated_render(valid_render());
    EXPECT_EQ(settings.max_path_length, 6U);
    EXPECT_EQ(settings.estimator, uint32_t{PT_ESTIMATOR_MIS});
    EXPECT_EQ(settings.sampler, uint32_t{PT_SAMPLER_SOBOL});
    EXPECT_EQ(settings.row_count, 480U);
}

TEST(RenderSettings, AcceptExtremes) {
    pt_render render = valid_render();
    render.max_path_length = 1024;
    for (const auto &[width, height] : {std::pair{1U, 1U}, {65535U, 65537U}, {4294967295U, 1U}}) {
        render.width = width;
        render.height = height;
        EXPECT_EQ(render_outcome(render), "accepted") << width;
    }
}

} // namespace
