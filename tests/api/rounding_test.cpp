#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <cstdint>
#include <vector>

namespace {

class RoundingTest : public ContextFixture {
protected:
    ~RoundingTest() override { std::fesetround(FE_TONEAREST); }

    struct Outcome {
        std::vector<float> image;
        double rmse;
        bool operator==(const Outcome &) const = default;
    };

    Outcome render(int rounding) {
        std::fesetround(rounding);
        const Context made = create_context([](pt_create_info &info) { info.flags = 0; });
        pt_context *on = made.get();
        const CourseworkScene coursework;
        const pt_scene scene = coursework.scene();
        pt_camera camera = CourseworkScene::camera();
        camera.position[0] = 0.1;
        const pt_render render = render_of(60, 33, 3);
        set_picture(on, scene, camera, render);
        const pt_accumulate_info samples = accumulate_info(17);
        EXPECT_EQ(pt_accumulate(on, &samples), PT_OK) << pt_last_error(on);
        Outcome outcome{std::vector<float>(60 * 33 * 3), 0.0};
        const pt_image image = image_target(outcome.image);
        EXPECT_EQ(pt_readback(on, &image), PT_OK) << pt_last_error(on);
        outcome.rmse = error_of(on).rmse;
        EXPECT_EQ(std::fegetround(), rounding);
        return outcome;
    }
};

TEST_F(RoundingTest, TheCallersModeChangesNoBit) {
    const Outcome nearest = render(FE_TONEAREST);
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO})
        EXPECT_TRUE(render(mode) == nearest) << mode;
}

} // namespace
