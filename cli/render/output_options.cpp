#include "cli/render/output_options.h"

#include "cli/base/common_options.h"
#include "cli/base/output_file.h"

#include <algorithm>
#include <iterator>

namespace cli {

std::vector<ImageTarget> OutputOptions::targets() const {
    std::vector<ImageTarget> all;
    std::transform(images.begin(), images.end(), std::back_inserter(all),
                   [this](const std::string &path) { return image_target(path, format); });
    return all;
}

bool OutputOptions::takes_standard_output() const {
    return stats == standard_stream || std::ranges::find(images, standard_stream) != images.end();
}

void add_format(CLI::App &command, std::optional<ImageFormat> &format, std::span<const std::string_view> names) {
    add_name(command, "--format", format, &find_image_format, "format", names,
             "Format of the image that goes to standard output")
        ->group("Output");
}

void add_png_bits(CLI::App &command, std::uint32_t &bits) {
    const auto read = [&bits](const std::string &text) {
        if (text != "8" && text != "16")
            refuse_option("--png-bits", "must be 8 or 16", text);
        bits = text == "8" ? 8 : 16;
    };
    command.add_option_function<std::string>("--png-bits", read, "Bits of a channel in .png (default: 8)")
        ->type_name("8|16")
        ->group("Display (.png and .jpg only)");
}

void add_output_options(CLI::App &command, OutputOptions &options) {
    command
        .add_option("-o,--output", options.images,
                    "Image to write, may be given again: .exr is linear 32-bit radiance; .png, .jpg are tone-mapped; "
                    "- is standard output")
        ->expected(1)
        ->take_all()
        ->type_name("IMAGE")
        ->group("Output");
    add_format(command, options.format, image_format_names);
    add_text(command, "--standard-error", options.standard_error, "EXR",
             "Write the standard error of every pixel (.exr), estimated from two parts of its samples")
        ->group("Output");
    add_text(command, "--film", options.film, "FILM",
             "Write the film (.ptfilm): the exact sums of the samples, for `pt merge`; -o may be left out then")
        ->group("Output");
    add_text(command, "--stats", options.stats, "JSON",
             "Write what is known of the image as JSON; - is standard output, the summary then goes to stderr")
        ->group("Output");
}

} // namespace cli
