#pragma once

#include "cli/base/number.h"
#include "cli/image/image_module.h"
#include "cli/picture/output_options.h"
#include "cli/render/stopping.h"
#include "cli/scene/scene_options.h"

#include <pt/pt.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

struct FrameRange {
    std::uint32_t first;
    std::uint32_t last;
};

inline std::optional<FrameRange> parse_frames(std::string_view text) {
    const std::size_t dash = text.find('-');
    const auto first = parse_number<std::uint32_t>(text.substr(0, dash));
    const auto last = dash == std::string_view::npos ? first : parse_number<std::uint32_t>(text.substr(dash + 1));
    return first && last && *first <= *last ? std::optional(FrameRange{*first, *last}) : std::nullopt;
}

// Replaces the last group of # by the number with leading zeros. Empty without a #.
inline std::optional<std::string> numbered_name(const std::string &pattern, std::uint32_t frame) {
    const std::size_t last = pattern.rfind('#');
    if (last == std::string::npos)
        return std::nullopt;
    const std::size_t first = pattern.find_last_not_of('#', last) + 1; // npos + 1 = 0
    const std::string digits = std::to_string(frame);
    const std::size_t width = last - first + 1;
    const std::string zeros(width > digits.size() ? width - digits.size() : 0, '0');
    return pattern.substr(0, first) + zeros + digits + pattern.substr(last + 1);
}

struct RenderOptions {
    std::string scene;
    std::vector<SceneOverride> overrides;
    OutputOptions output;
    std::string denoiser; // file of the library; empty for no denoising
    std::optional<Rectangle> crop;

    StoppingRules stopping;
    std::uint32_t sampling = PT_SAMPLING_BEST;
    std::uint32_t first_sample = 0;

    std::string checkpoint; // empty for no checkpoint
    bool resume = false;
    std::optional<double> checkpoint_seconds; // 30 by default
    std::optional<double> preview_seconds;    // empty for previews only after SIGUSR1

    std::optional<FrameRange> frames;
    bool skip_existing = false;

    std::string device;
    std::uint32_t submit_milliseconds = 0; // 0 for the library's default
    std::uint32_t piece_rows = 0;          // 0 for as many as fit
    bool validation = false;

    std::string shader_dir; // empty for the library's kernels
    bool watch = false;
    std::string progress = "auto";

    std::vector<std::uint32_t> wanted_layers() const;
};

} // namespace cli
