// The command `pt tonemap`: the display side of a file of radiance once more, without rendering.
#pragma once

#include "cli/image/image_file.h"
#include "cli/scene/scene_override.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace cli {

struct TonemapOptions {
    std::string input;
    std::string output;
    std::optional<ImageFormat> format;  // of an output that is standard output
    std::vector<SceneOverride> display; // how the image is shown
    std::uint32_t png_bits = 8;
    bool quiet = false;
};

extern const char *const tonemap_help;

// The options write into `options` when the command line is parsed, so it has to live as long as the command.
void add_tonemap_options(CLI::App &command, TonemapOptions &options);

// Returns the exit code; throws Failure.
int run_tonemap(const TonemapOptions &options);

} // namespace cli
