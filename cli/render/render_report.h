// The facts of a finished rendering, as image metadata, as the --stats file and as a line for people.
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
    std::optional<ToneMap> tone_map; // of files for displays; nothing if none is written
    std::string ended_by;            // "samples", "error", "signal", or another rule, as of StoppingTest
    std::vector<std::string> warnings;

    bool target_reached() const { return target_error > 0.0 && error.relative_rmse_high <= target_error; }
};

// What a film knows of the rendering that made it: neither times nor the scene's name.
RenderReport film_report(const FilmHandle &film);

nlohmann::ordered_json stats_json(const RenderReport &report);

// The parts of that file about the error and the tone map.
nlohmann::ordered_json error_json(const pt_error_estimate &error);
nlohmann::ordered_json tone_map_json(const RenderReport &report);

// "256x128, 64 spp in 1.23 s on llvmpipe"
std::string summary_text(const RenderReport &report);

// "error 0.42% (0.40% to 0.44%); target reached after 64 samples", for the relative error.
std::string error_text(const RenderReport &report);

// An image's metadata about the rendering. tone_map: how the radiance was mapped for a display; nullptr if it was not.
std::vector<ImageAttribute> image_metadata(const RenderReport &report, const ToneMap *tone_map);

} // namespace cli
