#pragma once

#include "tests/support/batch_fixture.h"
#include "tests/support/scene_of.h"
#include "tests/support/shared_context.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace analytic {

struct Image {
    std::uint32_t width;
    std::uint32_t height;
    std::vector<float> radiance;

    double red(std::uint32_t x, std::uint32_t y) const { return radiance[3 * (std::size_t{y} * width + x)]; }
};

// PT_TEST_TREE puts all spheres into trees, and divides sample counts by samples_for_one(), a power of two.
inline bool always_tree() {
    return std::getenv("PT_TEST_TREE") != nullptr;
}
inline std::uint32_t samples_for_one() {
    return always_tree() ? 8 : 1;
}

class AnalyticFixture : public BatchFixture {
protected:
    Context create_fixtures_context() override {
        return create_context([](pt_create_info &) {}, always_tree() ? &create_with_tree : &pt_create);
    }

    void TearDown() override {
        const bool has_tree = (stats().features & PT_FEATURE_TREE) != 0;
        EXPECT_TRUE(has_tree || !always_tree());
        BatchFixture::TearDown();
    }

    Image image_of(const pt_scene &scene, const pt_camera &camera, const pt_render &render,
                   std::uint32_t sample_count) {
        Image image{render.width, render.height, std::vector<float>(std::size_t{3} * render.width * render.height)};
        set_up(scene, camera);
        EXPECT_EQ(pt_set_render(context(), &render), PT_OK) << pt_last_error(context());
        accumulate(sample_count);
        readback(image.radiance);
        EXPECT_EQ(stats().rejected_samples, 0U);
        return image;
    }
};

} // namespace analytic
