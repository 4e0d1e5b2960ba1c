#pragma once

#include "cli/film/film.h"
#include "cli/image/image_module.h"
#include "cli/image/tone_map.h"

#include <pt/devices.h>
#include <pt/pt.h>
#include <pt/stats.h>

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

struct RenderReport {
    std::string scene;
    pt_render render;
    ImageWindow window;
    std::uint32_t requested_sample_count; // the maximum, if there is a target error
    double target_error;                  // 0 for none
    bool target_reached;
    pt_stats stats;
    pt_error_estimate error;
    pt_device_info device;
    bool is_denoised;
    double create_seconds;
    double accumulate_seconds;
    double total_seconds;
    std::optional<ToneMap> tone_map;
    std::string ended_by; // "samples", "error", "signal", or StoppingTest's result
    std::vector<std::string> warnings;
};

// A film has no times and no scene name.
RenderReport film_report(const FilmHandle &film);

nlohmann::ordered_json stats_json(const RenderReport &report);

nlohmann::ordered_json error_json(const pt_error_estimate &error);

std::string summary_text(const RenderReport &report);

// For example "error 0.42% (0.40% to 0.44%); target reached after 64 samples".
std::string error_text(const RenderReport &report);

// `tone_map` is nullptr for radiance.
std::vector<ImageAttribute> image_metadata(const RenderReport &report, const ToneMap *tone_map);

} // namespace cli
