// The options that say how radiance is shown, of `pt render` and `pt tonemap`.
#pragma once

#include "cli/image/exposure.h"
#include "cli/image/image_file.h"
#include "cli/image/tone_map.h"

#include <cstdint>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace cli {

// Nothing where the scene file or a default decides.
struct DisplayOptions {
    std::optional<Exposure> exposure;
    std::optional<ToneCurve> tone_curve;
    std::optional<double> gamma;
    std::uint32_t png_bits = 8; // of a channel
};

// otherwise: whose value counts, before the default, where an option is not given ("the scene's, else "); may be empty.
// The options write into `options` when the command line is parsed.
void add_display_options(CLI::App &command, DisplayOptions &options, const std::string &otherwise);

// The option --format, of an image that goes to standard output.
void add_format(CLI::App &command, std::optional<ImageFormat> &format);

} // namespace cli
