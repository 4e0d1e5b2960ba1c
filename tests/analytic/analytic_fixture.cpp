#include "tests/analytic/analytic_fixture.h"

#include "tests/support/shared_context.h"

#include <cstdlib>

namespace analytic {

bool always_tree() {
    return std::getenv("PT_TEST_TREE") != nullptr;
}

Context AnalyticFixture::create_fixtures_context() {
    return create_context([](pt_create_info &) {}, always_tree() ? &create_with_tree : &pt_create);
}

void AnalyticFixture::TearDown() {
    const bool has_tree = (stats().features & PT_FEATURE_TREE) != 0;
    EXPECT_TRUE(has_tree || !always_tree());
    BatchFixture::TearDown();
}

Image AnalyticFixture::image_of(const pt_scene &scene, const pt_camera &camera, const pt_render &render,
                                std::uint32_t sample_count) {
    Image image{render.width, render.height, std::vector<float>(std::size_t{3} * render.width * render.height)};
    set_up(scene, camera);
    EXPECT_EQ(pt_set_render(context(), &render), PT_OK) << pt_last_error(context());
    accumulate(sample_count);
    readback(image.radiance);
    EXPECT_EQ(stats().rejected_samples, 0U);
    return image;
}

} // namespace analytic
