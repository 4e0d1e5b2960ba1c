#pragma once

#include "tests/support/coursework_scene.h"
#include "tests/support/image_target.h"
#include "tests/support/scene_of.h"

#include <pt/film.h>
#include <pt/pt.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

inline void set_picture(pt_context *on, const pt_scene &scene, const pt_camera &camera, const pt_render &render) {
    ASSERT_EQ(pt_set_scene(on, &scene), PT_OK) << pt_last_error(on);
    ASSERT_EQ(pt_set_camera(on, &camera), PT_OK) << pt_last_error(on);
    ASSERT_EQ(pt_set_render(on, &render), PT_OK) << pt_last_error(on);
}

inline void set_coursework(pt_context *on, const pt_render &render,
                           const pt_camera &camera = CourseworkScene::camera()) {
    const CourseworkScene coursework;
    set_picture(on, coursework.scene(), camera, render);
}

inline void accumulate_on(pt_context *on, std::uint32_t sample_count) {
    const pt_accumulate_info info = accumulate_info(sample_count);
    ASSERT_EQ(pt_accumulate(on, &info), PT_OK) << pt_last_error(on);
}

inline std::vector<char> film_of(pt_context *of) {
    std::uint64_t size = 0;
    EXPECT_EQ(pt_save_film(of, nullptr, &size), PT_OK) << pt_last_error(of);
    std::vector<char> film(size);
    EXPECT_EQ(pt_save_film(of, film.data(), &size), PT_OK) << pt_last_error(of);
    return film;
}

inline std::vector<float> values_of(pt_context *from, std::size_t pixel_count,
                                    std::uint32_t quantity = PT_QUANTITY_RADIANCE) {
    std::vector<float> values(3 * pixel_count, -7.0F);
    const pt_image target = image_target(values, quantity);
    EXPECT_EQ(pt_readback(from, &target), PT_OK) << pt_last_error(from);
    return values;
}
