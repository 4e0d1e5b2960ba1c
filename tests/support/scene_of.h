#pragma once

#include <pt/pt.h>

#include <span>

inline pt_scene scene_of(std::span<const pt_material> materials, std::span<const pt_sphere> spheres,
                         std::span<const pt_plane> planes) {
    pt_scene scene{};
    scene.struct_size = sizeof scene;
    scene.material_count = static_cast<uint32_t>(materials.size());
    scene.sphere_count = static_cast<uint32_t>(spheres.size());
    scene.plane_count = static_cast<uint32_t>(planes.size());
    scene.materials = materials.data();
    scene.spheres = spheres.data();
    scene.planes = planes.data();
    return scene;
}

inline pt_render render_of(uint32_t width, uint32_t height, uint32_t max_path_length) {
    pt_render render{};
    render.struct_size = sizeof render;
    render.width = width;
    render.height = height;
    render.max_path_length = max_path_length;
    return render;
}
