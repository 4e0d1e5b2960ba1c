// The facts of a finished rendering: image metadata, the --stats file, and lines for people.
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
    ImageWindow window;                   // of the images
    std::uint32_t requested_sample_count; // with a target error, the most
    double target_error;                  // relative; 0: none
    pt_stats stats;
    pt_error_estimate error;
    pt_device_info device;
    bool is_denoised;
    double create_seconds;
    double accumulate_seconds;
    double total_seconds;
    std::optional<ToneMap> tone_map; // of files for displays; empty without any
    std::string ended_by;            // "samples", "error", "signal", or another rule (StoppingTest)
    std::vector<std::string> warnings;

    bool target_reached() const { return target_error > 0.0 && error.relative_rmse_high <= target_error; }
};

// The facts in a film, without times and the scene's name.
RenderReport film_report(const FilmHandle &film);

nlohmann::ordered_json stats_json(const RenderReport &report);

// The sections of the error and the tone map.
nlohmann::ordered_json error_json(const pt_error_estimate &error);
nlohmann::ordered_json tone_map_json(const RenderReport &report);

// "256x128, 64 spp in 1.23 s on llvmpipe"
std::string summary_text(const RenderReport &report);

// The relative error: "error 0.42% (0.40% to 0.44%); target reached after 64 samples".
std::string error_text(const RenderReport &report);

// Metadata about the rendering. tone_map: nullptr if the radiance was not mapped.
std::vector<ImageAttribute> image_metadata(const RenderReport &report, const ToneMap *tone_map);

} // namespace cli
