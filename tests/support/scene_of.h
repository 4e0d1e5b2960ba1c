// A pt_scene and a pt_render from their parts, the sizes filled in. Used by the tests that describe scenes.
#pragma once

#include <pt/pt.h>

#include <span>

// Refers to the arrays, which must outlive it.
inline pt_scene scene_of(std::span<const pt_material> materials, std::span<const pt_sphere> spheres,
                         std::span<const pt_plane> planes) {
    return {sizeof(pt_scene),
            static_cast<uint32_t>(materials.size()),
            static_cast<uint32_t>(spheres.size()),
            static_cast<uint32_t>(planes.size()),
            materials.data(),
            spheres.data(),
            planes.data()};
}

// All else by default.
inline pt_render render_of(uint32_t width, uint32_t height, uint32_t max_path_length) {
    pt_render render{};
    render.struct_size = sizeof render;
    render.width = width;
    render.height = height;
    render.max_path_length = max_path_length;
    return render;
}
