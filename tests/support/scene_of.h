#pragma once

#include "tests/support/sized.h"

#include <pt/pt.h>

#include <algorithm>
#include <array>
#include <span>

inline pt_scene scene_of(std::span<const pt_material> materials, std::span<const pt_sphere> spheres,
                         std::span<const pt_plane> planes, std::span<const pt_sphere_array> arrays = {}) {
    auto scene = sized<pt_scene>();
    scene.material_count = static_cast<uint32_t>(materials.size());
    scene.sphere_count = static_cast<uint32_t>(spheres.size());
    scene.plane_count = static_cast<uint32_t>(planes.size());
    scene.materials = materials.data();
    scene.spheres = spheres.data();
    scene.planes = planes.data();
    scene.sphere_array_count = static_cast<uint32_t>(arrays.size());
    scene.sphere_arrays = arrays.data();
    return scene;
}

inline pt_sphere_array array_of(std::size_t count, const pt_column &center, const pt_column &radius) {
    auto array = sized<pt_sphere_array>();
    array.count = static_cast<uint32_t>(count);
    array.center = center;
    array.radius = radius;
    return array;
}

inline pt_render render_of(uint32_t width, uint32_t height, uint32_t max_path_length) {
    auto render = sized<pt_render>();
    render.width = width;
    render.height = height;
    render.max_path_length = max_path_length;
    return render;
}

inline pt_camera camera_at(const std::array<double, 3> &position, const std::array<double, 3> &target,
                           double vertical_fov = 0.0, const std::array<double, 3> &up = {0, 1, 0}) {
    auto camera = sized<pt_camera>();
    camera.shutter_close = 1;
    camera.vertical_fov = vertical_fov;
    std::ranges::copy(position, camera.position);
    std::ranges::copy(target, camera.target);
    std::ranges::copy(up, camera.up);
    return camera;
}

inline pt_accumulate_info accumulate_info(uint32_t sample_count, double target_error = 0.0,
                                          pt_progress_fn progress = nullptr, void *user = nullptr) {
    auto info = sized<pt_accumulate_info>();
    info.sample_count = sample_count;
    info.stopping.target_error = target_error;
    info.progress = progress;
    info.progress_user = user;
    return info;
}
