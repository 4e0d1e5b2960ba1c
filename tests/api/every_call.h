#pragma once

#include "tests/api/api_fixture.h"
#include "tests/support/sized.h"

#include <pt/accuracy.h>
#include <pt/async.h>
#include <pt/devices.h>
#include <pt/errors.h>
#include <pt/map.h>
#include <pt/pt.h>
#include <pt/shaders.h>
#include <pt/stats.h>
#include <pt/vulkan.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace api {

using Outcomes = std::map<std::string, std::string>;

inline Outcomes outcomes_of_every_call(pt_context *context) {
    const pt_scene scene = valid_scene();
    const pt_camera camera = valid_camera();
    const pt_render render = valid_render();
    const pt_accumulate_info one = accumulate_info(1);
    std::vector<float> pixels(width * height * 3);
    const pt_image image = image_target(pixels);
    auto mapped = sized<pt_image>();
    void *data = nullptr;
    auto buffer_image = sized<pt_buffer_image>();
    pt_device_info device{};
    auto stats = sized<pt_stats>();
    auto error = sized<pt_error_estimate>();
    auto warning = sized<pt_broken_rule>();
    std::uint32_t count = 0;
    const std::map<std::string, std::function<pt_result()>> calls = {
        {"pt_get_context_device", [&] { return pt_get_context_device(context, &device); }},
        {"pt_set_scene", [&] { return pt_set_scene(context, &scene); }},
        {"pt_set_camera", [&] { return pt_set_camera(context, &camera); }},
        {"pt_set_render", [&] { return pt_set_render(context, &render); }},
        {"pt_reload_shaders", [&] { return pt_reload_shaders(context); }},
        {"pt_prepare", [&] { return pt_prepare(context); }},
        {"pt_accumulate", [&] { return pt_accumulate(context, &one); }},
        {"pt_start", [&] { return pt_start(context, &one); }},
        {"pt_readback", [&] { return pt_readback(context, &image); }},
        {"pt_map_image", [&] { return pt_map_image(context, &mapped, &data, nullptr); }},
        {"pt_readback_to_buffer", [&] { return pt_readback_to_buffer(context, &buffer_image); }},
        {"pt_get_stats", [&] { return pt_get_stats(context, &stats); }},
        {"pt_get_warning", [&] { return pt_get_warning(context, &warning); }},
        {"pt_get_error_estimate", [&] { return pt_get_error_estimate(context, &error); }},
        {"pt_get_accuracy", [&] { return pt_get_accuracy(context, nullptr, &count); }},
    };
    Outcomes outcomes;
    for (const auto &[name, call] : calls) {
        const pt_result result = call();
        outcomes[name] = std::string(pt_result_name(result)) + ": " + pt_last_error(context);
    }
    return outcomes;
}

inline void expect_every_call(const Outcomes &outcomes, const std::string &expected) {
    EXPECT_EQ(outcomes.size(), 15U);
    for (const auto &[name, outcome] : outcomes)
        EXPECT_EQ(outcome, expected) << name;
}

} // namespace api
