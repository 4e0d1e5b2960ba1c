// The options of `pt render`: their names, help and syntax.
#pragma once

#include "cli/base/number.h"
#include "cli/image/display_options.h"
#include "cli/image/image_file.h"
#include "cli/render/frame_range.h"
#include "cli/scene/scene_override.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace cli {

struct RenderOptions {
    std::string scene;
    std::vector<SceneOverride> overrides; // of its values
    std::vector<std::string> outputs;
    std::optional<ImageFormat> format; // of an output that is standard output
    std::string standard_error;        // path of the image of standard errors; empty: none
    std::vector<std::uint32_t> layers; // of each .exr beside its radiance, PT_QUANTITY_*
    bool alpha = false;
    std::string stats;
    bool parts = false;     // as they are asked for, in place of all outputs
    std::string film;       // path of the film; empty: none
    std::string checkpoint; // likewise
    bool resume = false;
    std::optional<double> checkpoint_seconds;
    std::optional<double> preview_seconds; // nothing: only when SIGUSR1 asks

    // Nothing where the scene file or a default decides.
    std::optional<ImageSize> size;
    std::optional<Rectangle> crop;
    std::optional<std::uint32_t> sample_count;
    std::optional<double> target_error; // relative; nothing: take all samples
    std::optional<std::uint32_t> sampling;
    std::optional<double> time_limit; // seconds, of each frame
    std::optional<std::uint64_t> seed;
    std::optional<std::uint32_t> max_path_length;
    std::optional<std::uint32_t> sampler;
    std::optional<std::uint32_t> estimator;
    std::uint32_t first_sample = 0;

    DisplayOptions display; // of .png and .jpg alone

    std::optional<FrameRange> frames; // of an animation; nothing: a picture
    bool skip_existing = false;       // of these frames

    std::string device;
    std::uint32_t submit_milliseconds = 0; // 0: the library's default
    std::uint32_t piece_rows = 0;          // 0: as many as the device has memory for
    bool validation = false;

    std::string shader_dir; // empty: the library's own kernels
    bool watch = false;

    std::string progress = "auto";
    bool quiet = false;
};

inline constexpr double default_checkpoint_seconds = 30.0;

extern const char *const render_help;

// The options write into `options` when the command line is parsed, so it has to live as long as the command.
void add_render_options(CLI::App &command, RenderOptions &options);

} // namespace cli
