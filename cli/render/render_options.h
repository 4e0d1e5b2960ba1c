// The options of `pt render`: their names, help and syntax.
#pragma once

#include "cli/image/image_window.h"
#include "cli/render/frame_range.h"
#include "cli/render/output_options.h"
#include "cli/scene/scene_override.h"

#include <pt/pt.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace cli {

struct RenderOptions {
    std::string scene;
    std::vector<SceneOverride> overrides; // of its values, also by options that say the same
    OutputOptions output;
    std::vector<std::uint32_t> layers; // of each .exr beside its radiance, PT_QUANTITY_*
    bool alpha = false;
    std::optional<Rectangle> crop;

    double target_error = 0.0; // relative; 0: take all samples
    std::uint32_t sampling = PT_SAMPLING_BEST;
    std::optional<double> time_limit; // seconds, of each frame
    std::uint32_t first_sample = 0;

    bool parts = false;     // as they are asked for, in place of all outputs
    std::string checkpoint; // path of the film; empty: none
    bool resume = false;
    std::optional<double> checkpoint_seconds; // nothing: 30
    std::optional<double> preview_seconds;    // nothing: only when SIGUSR1 asks

    std::optional<FrameRange> frames; // of an animation; nothing: a picture
    bool skip_existing = false;       // of these frames

    std::string device;
    std::uint32_t submit_milliseconds = 0; // 0: the library's default
    std::uint32_t piece_rows = 0;          // 0: as many as the device has memory for
    bool validation = false;

    std::string shader_dir; // empty: the library's own kernels
    bool watch = false;
    std::string progress = "auto";

    // The layers that have to be read, that of alpha among them: PT_QUANTITY_*.
    std::vector<std::uint32_t> wanted_layers() const;
};

extern const char *const render_help;

// The options write into `options` when the command line is parsed, so it has to live as long as the command.
void add_render_options(CLI::App &command, RenderOptions &options);

} // namespace cli
