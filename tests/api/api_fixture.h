#pragma once

#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace api {

inline constexpr uint32_t width = 12;
inline constexpr uint32_t height = 7;

// A sphere around the camera. Every pixel has exactly its emission.
inline const pt_material material{{0, 0, 0}, {0, 0, 0}, {1, 2, 4}, 0, 0};
inline const pt_sphere sphere{{0, 0, 0}, 9, {0, 0, 0}, 0, 0};
inline const std::array<float, 3> radiance{1, 2, 4};

inline pt_scene valid_scene() {
    return scene_of({&material, 1}, {&sphere, 1}, {});
}

inline pt_camera valid_camera() {
    return camera_at({0, 0, 0}, {0, 0, -1});
}

inline pt_render valid_render() {
    return render_of(width, height, 1);
}

inline void set_all(pt_context *context) {
    const pt_scene scene = valid_scene();
    const pt_camera camera = valid_camera();
    const pt_render render = valid_render();
    set_picture(context, scene, camera, render);
}

class ApiTest : public ContextFixture {
protected:
    void set_all() { api::set_all(context()); }

    std::string message() const { return pt_last_error(context()); }

    void expect_failure(pt_result result, pt_result expected, const std::string &expected_message) const {
        EXPECT_EQ(pt_result_name(result), std::string(pt_result_name(expected)));
        EXPECT_EQ(message(), expected_message);
    }

    void expect_image(uint32_t sample_count) {
        EXPECT_EQ(stats().sample_count, sample_count);
        const std::vector<float> pixels = values_of(context(), width * height);
        for (std::size_t i = 0; i < pixels.size(); ++i)
            ASSERT_EQ(pixels[i], radiance[i % 3]) << "value " << i;
    }
};

} // namespace api
