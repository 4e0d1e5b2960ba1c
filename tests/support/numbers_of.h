#pragma once

#include "lib/base/error.h"
#include "lib/scene/render_settings.h"
#include "tests/support/scene_of.h"

#include <cstdint>
#include <vector>

// Returns all estimators or samplers, from 1 to the last that the library accepts.
inline std::vector<std::uint32_t> numbers_of(std::uint32_t pt_render::*choice) {
    std::vector<std::uint32_t> numbers;
    pt_render render = render_of(1, 1, 1);
    try {
        for (render.*choice = 1;; ++(render.*choice)) {
            (void)pt::validated_render(render);
            numbers.push_back(render.*choice);
        }
    } catch (const pt::Error &) {
        return numbers;
    }
}
