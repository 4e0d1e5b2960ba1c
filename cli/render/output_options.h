// The options of a command that say which files it writes: their names, help and syntax.
#pragma once

#include "cli/image/image_target.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace cli {

struct OutputOptions {
    std::vector<std::string> images;   // paths, like all here
    std::optional<ImageFormat> format; // of an image that is standard output
    std::string standard_error;        // of the image of standard errors; empty: none, as of those below
    std::string film;
    std::string stats;
    std::uint32_t png_bits = 8; // of a channel
    bool quiet = false;

    // Of images whose names were checked.
    std::vector<ImageTarget> targets() const;

    // Whether an image or the report goes there, so that lines for people do not.
    bool takes_standard_output() const;
};

// The options write into `options` when the command line is parsed. All but those of quiet and png_bits.
void add_output_options(CLI::App &command, OutputOptions &options);

// Of an image that goes to standard output. names: of the formats that the command can write.
void add_format(CLI::App &command, std::optional<ImageFormat> &format, std::span<const std::string_view> names);

void add_png_bits(CLI::App &command, std::uint32_t &bits);

} // namespace cli
