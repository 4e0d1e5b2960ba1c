// Merges the command line, the scene file and the defaults: the first that has a value counts.
#pragma once

#include "cli/base/exit_code.h"
#include "cli/base/library_error.h"
#include "cli/image/image_window.h"
#include "cli/render/render_options.h"
#include "cli/scene/scene_file.h"

#include <pt/pt.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// Pixels.
inline constexpr std::uint32_t default_side = 512;

// Of a pixel, where a target error or a time says when to stop.
inline constexpr std::uint32_t default_most_samples = 65536;

struct RenderSettings {
    pt_render render;           // of the whole picture
    ImageWindow window;         // the part of it that is wanted
    std::uint32_t sample_count; // the most, if there is a target
    double target_error;        // relative; 0: none
    std::uint32_t sampling;     // PT_SAMPLING_*
    Exposure exposure;
    ToneCurve tone_curve;
    std::optional<double> gamma;
    std::vector<std::string_view> scene_members; // of pt_render and pt_accumulate_info: what the scene file gave

    // The rules that are broken, of which there must be some, in the words of whoever gave the value: the command line
    // (ExitCode::usage) or the scene file (ExitCode::scene).
    Failure explain(const LibraryError &error, const SceneFile &scene) const;

    // Whether the scene file says how large the image is, or a side of it.
    bool is_size_from_scene() const;

private:
    bool is_from_scene(const BrokenRule &rule) const;
    bool gives(std::string_view member) const;
};

RenderSettings merge_settings(const RenderOptions &options, const SceneFile &scene);

} // namespace cli
