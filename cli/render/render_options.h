// Frames of an animation, and their numbers in the names of files.
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
    std::uint32_t last; // not before the first
};

// Parses "0-23", or just "5"; nothing for any other text.
inline std::optional<FrameRange> parse_frames(std::string_view text) {
    const std::size_t dash = text.find('-');
    const auto first = parse_number<std::uint32_t>(text.substr(0, dash));
    const auto last = dash == std::string_view::npos ? first : parse_number<std::uint32_t>(text.substr(dash + 1));
    return first && last && *first <= *last ? std::optional(FrameRange{*first, *last}) : std::nullopt;
}

// The name of a frame's file: the last run of # signs is replaced by its number, with leading zeros to as many digits.
// Nothing if there is no #.
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
    std::vector<std::string> images;   // paths, like all here
    std::optional<ImageFormat> format; // of an image to standard output
    std::vector<std::uint32_t> layers; // in each .exr beside the radiance: PT_QUANTITY_*
    std::string film;                  // empty: none; so for the report
    std::string stats;
    bool quiet = false;

    // The images to be written. Their names must have been checked.
    std::vector<ImageTarget> targets() const;

    // Whether an image or the report goes to standard output, so that messages for people must not.
    bool takes_standard_output() const;
};

// Calls use(option, path) for every file that is to be written.
template <typename Options, typename Use>
void for_each_output(Options &options, Use use) {
    for (auto &path : options.images)
        use("-o", path);
    use("--film", options.film);
    use("--stats", options.stats);
}

// Adds the options for images and the report; they write into `options` when the command line is parsed.
void add_image_outputs(CLI::App &command, OutputOptions &options);

// Adds all output options except --quiet. layers: those that the command can write.
void add_output_options(CLI::App &command, OutputOptions &options, std::span<const std::string_view> layers);

// Adds --format, for an image to standard output. names: the formats that the command can write.
void add_format(CLI::App &command, std::optional<ImageFormat> &format, std::span<const std::string_view> names);

struct RenderOptions {
    std::string scene;
    std::vector<SceneOverride> overrides; // of the scene's values, including those by options of their own
    OutputOptions output;
    bool alpha = false;
    std::string denoiser; // file of Open Image Denoise; empty: the picture is as its samples make it
    std::optional<Rectangle> crop;

    StoppingRules stopping;
    std::uint32_t sampling = PT_SAMPLING_BEST;
    std::uint32_t first_sample = 0;

    bool parts = false;     // render parts on request, without other outputs
    std::string checkpoint; // path of the film; empty: none
    bool resume = false;
    std::optional<double> checkpoint_seconds; // nothing: 30
    std::optional<double> preview_seconds;    // nothing: only when SIGUSR1 asks

    std::optional<FrameRange> frames; // of an animation; nothing: a single picture
    bool skip_existing = false;       // frames whose files exist

    std::string device;
    std::uint32_t submit_milliseconds = 0; // 0: the library's default
    std::uint32_t piece_rows = 0;          // 0: as many as the device has memory for
    bool validation = false;

    std::string shader_dir; // empty: the library's own kernels
    bool watch = false;
    std::string progress = "auto";

    // The quantities that have to be read for the layers, alpha and denoising: PT_QUANTITY_*.
    std::vector<std::uint32_t> wanted_layers() const;
};

} // namespace cli
