// The options that say how radiance is shown, of `pt render` and `pt tonemap`.
#pragma once

#include "cli/image/exposure.h"
#include "cli/image/image_file.h"
#include "cli/image/tone_map.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace CLI {
class App;
class Option;
} // namespace CLI

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

// The option --format, of an image that goes to standard output. names: of the formats that the command can write.
CLI::Option *add_format(CLI::App &command, std::optional<ImageFormat> &format, std::span<const std::string_view> names);

} // namespace cli
