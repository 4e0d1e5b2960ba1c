// The options of `pt merge`: their names, help and syntax.
#pragma once

#include "cli/render/render_options.h"

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

    RenderOptions output; // what is written, and how pictures are mapped; nothing else of it is used
};

extern const char *const merge_help;

// The options write into `options` when the command line is parsed, so it has to live as long as the command.
void add_merge_options(CLI::App &command, MergeOptions &options);

} // namespace cli
