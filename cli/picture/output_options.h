#pragma once

#include "cli/image/image_file.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace cli {

struct OutputOptions {
    std::vector<std::string> images;
    std::optional<ImageFormat> format; // for standard output
    std::vector<std::uint32_t> layers; // PT_QUANTITY_* in .exr files besides the radiance
    bool alpha = false;
    std::string film; // empty for no film
    std::string stats;
    bool quiet = false;

    std::vector<ImageTarget> targets() const;

    bool takes_standard_output() const;
};

template <typename Options, typename Use>
void for_each_output(Options &options, Use use) {
    for (auto &path : options.images)
        use("-o", path);
    use("--film", options.film);
    use("--stats", options.stats);
}

void add_image_outputs(CLI::App &command, OutputOptions &options);

// `layers` are the permitted names.
void add_output_options(CLI::App &command, OutputOptions &options, std::span<const std::string_view> layers);

void add_format(CLI::App &command, std::optional<ImageFormat> &format, std::span<const std::string_view> names);

} // namespace cli
