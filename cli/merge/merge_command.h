// The command `pt merge`: films of one picture in, images and their sum out.
#pragma once

#include "cli/render/render_options.h"
#include "cli/scene/scene_override.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

struct MergeOptions {
    std::vector<std::string> parts;

    // The range of which missing samples are told: that of the parts' first and last one where nothing is given.
    std::optional<std::uint32_t> first_sample;
    std::optional<std::uint32_t> sample_count;

    OutputOptions output;
    std::vector<SceneOverride> display; // how pictures are shown
};

extern const char *const merge_help;

// The options write into `options` when the command line is parsed, so it has to live as long as the command.
void add_merge_options(CLI::App &command, MergeOptions &options);

// Returns the exit code; throws Failure.
int run_merge(const MergeOptions &options);

} // namespace cli
