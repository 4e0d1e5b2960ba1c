// Owns the merge of command line, scene file and defaults, in this order of rank.
// Called by render_command.
#pragma once

#include "exit_code.h"
#include "render_options.h"
#include "scene_file.h"

#include <pt/pt.h>

#include <cstdint>
#include <string>

namespace cli {

struct RenderSettings {
    pt_render render;
    std::uint32_t sample_count; // the most, if there is a target
    double target_error;        // relative; 0: none
    bool size_from_scene;
    bool max_path_length_from_scene;

    // Who gave the value that the library's message complains of: ExitCode::scene or ExitCode::usage.
    ExitCode blame(const std::string &message) const;
};

RenderSettings merge_settings(const RenderOptions &options, const SceneFile &scene);

} // namespace cli
