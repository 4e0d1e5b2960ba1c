// The options of `pt render`, and the frames of an animation.
#pragma once

#include "cli/base/number.h"
#include "cli/image/image_file.h"
#include "cli/image/image_module.h"
#include "cli/render/stopping.h"
#include "cli/scene/scene_override.h"

#include <pt/pt.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace cli {

struct FrameRange {
    std::uint32_t first;
    std::uint32_t last; // >= first
};

// Parses "0-23" or "5"; empty for other texts.
inline std::optional<FrameRange> parse_frames(std::string_view text) {
    const std::size_t dash = text.find('-');
    const auto first = parse_number<std::uint32_t>(text.substr(0, dash));
    const auto last = dash == std::string_view::npos ? first : parse_number<std::uint32_t>(text.substr(dash + 1));
    return first && last && *first <= *last ? std::optional(FrameRange{*first, *last}) : std::nullopt;
}

// Replaces the last run of # signs by the number, with leading zeros to as many digits. Empty without a #.
inline std::optional<std::string> numbered_name(const std::string &pattern, std::uint32_t frame) {
    const std::size_t last = pattern.rfind('#');
    if (last == std::string::npos)
        return std::nullopt;
    const std::size_t first = pattern.find_last_not_of('#', last) + 1; // npos + 1 = 0: the name begins with it
    const std::string digits = std::to_string(frame);
    const std::size_t width = last - first + 1;
    const std::string zeros(width > digits.size() ? width - digits.size() : 0, '0');
    return pattern.substr(0, first) + zeros + digits + pattern.substr(last + 1);
}

struct OutputOptions {
    std::vector<std::string> images;   // paths
    std::optional<ImageFormat> format; // of an image to standard output
    std::vector<std::uint32_t> layers; // PT_QUANTITY_*, in each .exr beside the radiance
    std::string film;                  // empty: none; so for stats
    std::string stats;
    bool quiet = false;

    // Their names must have been checked.
    std::vector<ImageTarget> targets() const;

    // Whether an image or the report goes to standard output, so that messages must not.
    bool takes_standard_output() const;
};

// Calls use(option, path) for every file to be written.
template <typename Options, typename Use>
void for_each_output(Options &options, Use use) {
    for (auto &path : options.images)
        use("-o", path);
    use("--film", options.film);
    use("--stats", options.stats);
}

// Options for images and the report; parsing writes into `options`.
void add_image_outputs(CLI::App &command, OutputOptions &options);

// All output options except --quiet. layers: that the command can write.
void add_output_options(CLI::App &command, OutputOptions &options, std::span<const std::string_view> layers);

// --format, for an image to standard output. names: formats that the command can write.
void add_format(CLI::App &command, std::optional<ImageFormat> &format, std::span<const std::string_view> names);

struct RenderOptions {
    std::string scene;
    std::vector<SceneOverride> overrides; // including those by options of their own
    OutputOptions output;
    bool alpha = false;
    std::string denoiser; // file of Open Image Denoise; empty: not denoised
    std::optional<Rectangle> crop;

    StoppingRules stopping;
    std::uint32_t sampling = PT_SAMPLING_BEST;
    std::uint32_t first_sample = 0;

    bool parts = false;     // on request, without other outputs
    std::string checkpoint; // path; empty: none
    bool resume = false;
    std::optional<double> checkpoint_seconds; // empty: 30
    std::optional<double> preview_seconds;    // empty: only after SIGUSR1

    std::optional<FrameRange> frames; // empty: a single picture
    bool skip_existing = false;       // frames whose files exist

    std::string device;
    std::uint32_t submit_milliseconds = 0; // 0: the library's default
    std::uint32_t piece_rows = 0;          // 0: as many as fit the device's memory
    bool validation = false;

    std::string shader_dir; // empty: the library's kernels
    bool watch = false;
    std::string progress = "auto";

    // PT_QUANTITY_* to be read for layers, alpha and denoising.
    std::vector<std::uint32_t> wanted_layers() const;
};

} // namespace cli
