#include "cli/picture/output_options.h"

#include "cli/base/file.h"
#include "cli/base/options.h"
#include "cli/base/text.h"
#include "cli/picture/picture_layer.h"

#include <algorithm>
#include <iterator>
#include <sstream>

namespace cli {
namespace {

std::vector<std::uint32_t> parse_layers(const std::string &text, std::span<const std::string_view> known) {
    const ValueRule rule{.form = ValueRule::Form::name, .kind = "layer", .names = known};
    std::vector<std::uint32_t> quantities;
    std::istringstream names(text + ",");
    for (std::string name; std::getline(names, name, ',');) {
        read_value("--layers", name, rule);
        const std::uint32_t quantity = file_layers.find(name).value().quantity;
        if (std::find(quantities.begin(), quantities.end(), quantity) != quantities.end())
            refuse_option("--layers", "must name a layer once", text);
        quantities.push_back(quantity);
    }
    std::erase(quantities, std::uint32_t{PT_QUANTITY_RADIANCE});
    return quantities;
}

} // namespace

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
    add_name(command, "--format", format, &format_of_name, "format", names, "Format of the image on standard output")
        ->group("Output");
}

void add_image_outputs(CLI::App &command, OutputOptions &options) {
    command.option_defaults()->group("Output");
    command
        .add_option("-o,--output", options.images,
                    concat("Image to write, may be given again: ", extensions(&ImageFormat::is_radiance),
                           " is linear 32-bit radiance; ", extensions(is_for_displays),
                           " are tone-mapped; - is standard output"))
        ->expected(1)
        ->take_all()
        ->type_name("IMAGE");
    add_format(command, options.format, image_format_names);
    add_text(command, "--stats", options.stats, "JSON",
             "Write a report as JSON; - is standard output, the summary then goes to stderr");
}

void add_output_options(CLI::App &command, OutputOptions &options, std::span<const std::string_view> layers) {
    add_image_outputs(command, options);
    const auto read_layers = [&options, layers](const std::string &text) {
        options.layers = parse_layers(text, layers);
    };
    command
        .add_option_function<std::string>("--layers", read_layers,
                                          "Layers of " + extensions(&ImageFormat::is_radiance) +
                                              " beside the mean, separated by commas")
        ->type_name(listed(layers, "|") + ",...");
    command.add_flag("--alpha", options.alpha,
                     "Give " + extensions(&ImageFormat::has_alpha, " and ") +
                         " an alpha channel: the fraction of a pixel's samples that hit a surface");
    add_text(command, "--film", options.film, "FILM",
             "Write the film (.ptfilm): the exact sums of the samples, for `pt merge`; -o is then optional");
}

} // namespace cli
