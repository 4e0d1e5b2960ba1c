#pragma once

#include "tests/support/context_calls.h"

#include <pt/pt.h>

#include <cstdint>
#include <vector>

inline std::vector<float> render_image(pt_context *context, const pt_scene &scene, const pt_camera &camera,
                                       const pt_render &render, std::uint32_t samples) {
    set_picture(context, scene, camera, render);
    accumulate_on(context, samples);
    return values_of(context, std::size_t{render.width} * render.height);
}
