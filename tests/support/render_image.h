#pragma once

#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"

#include <pt/pt.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

inline std::vector<float> render_image(pt_context *context, const pt_scene &scene, const pt_camera &camera,
                                       const pt_render &render, std::uint32_t samples) {
    const pt_accumulate_info count = accumulate_info(samples);
    std::vector<float> image(std::size_t{3} * render.width * render.height);
    const pt_image target = image_target(image);
    EXPECT_EQ(pt_set_scene(context, &scene), PT_OK) << pt_last_error(context);
    EXPECT_EQ(pt_set_camera(context, &camera), PT_OK) << pt_last_error(context);
    EXPECT_EQ(pt_set_render(context, &render), PT_OK) << pt_last_error(context);
    EXPECT_EQ(pt_accumulate(context, &count), PT_OK) << pt_last_error(context);
    EXPECT_EQ(pt_readback(context, &target), PT_OK) << pt_last_error(context);
    return image;
}
