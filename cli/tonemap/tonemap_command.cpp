#include "cli/base/devices.h"
#include "cli/base/exit_code.h"
#include "cli/base/file.h"
#include "cli/base/options.h"
#include "cli/commands.h"
#include "cli/image/image_file.h"
#include "cli/image/tone_map.h"
#include "cli/picture/output_options.h"
#include "cli/scene/scene.h"

#include <algorithm>
#include <cmath>

namespace cli {
namespace {

struct TonemapOptions {
    std::string input;
    std::string output;
    std::optional<ImageFormat> format; // for standard output
    std::vector<SceneOverride> display;
    bool quiet = false;
};

void check(const TonemapOptions &options) {
    check_image_names({&options.output, 1}, options.format);
    refuse_if(image_target(options.output, options.format).format.is_radiance,
              options.output + ": the name must end in one of " + extensions(is_for_displays));
    require_distinct_files({{"the image", options.input}}, {{"the output", options.output}});
}

// Images of other programs may extend outside the picture. They are treated as whole pictures.
ImageWindow window_of(const DecodedImage &image) {
    const auto inside = [](std::int32_t first, std::uint32_t count, std::uint32_t full) {
        return first >= 0 && static_cast<std::uint64_t>(first) + count <= full;
    };
    if (!inside(image.x, image.width, image.full_width) || !inside(image.y, image.height, image.full_height))
        return whole_window(image.width, image.height);
    return image.window();
}

[[noreturn]] void refuse(const DecodedImage &image, std::size_t pixel, const std::string &what) {
    throw Failure(ExitCode::file, "cannot read " + image.path + ": pixel " + std::to_string(pixel % image.width) + "," +
                                      std::to_string(pixel / image.width) + what);
}

std::vector<float> radiance_of(const DecodedImage &image) {
    refuse_if(!image.is_float,
              "cannot read " + image.path + ": holds whole numbers, as displays take them, not linear radiance",
              ExitCode::file);
    const std::vector<float> radiance = image.layer("");
    const auto bad = std::find_if(radiance.begin(), radiance.end(), [](float value) { return !std::isfinite(value); });
    if (bad != radiance.end())
        refuse(image, static_cast<std::size_t>(bad - radiance.begin()) / 3, " is not finite");
    return radiance;
}

std::vector<float> alpha_of(const DecodedImage &image, const ImageFormat &format) {
    const auto channel = std::find(image.channels.begin(), image.channels.end(), "A");
    if (channel == image.channels.end() || !format.has_alpha)
        return {};
    std::vector<float> alpha;
    alpha.reserve(std::size_t{image.width} * image.height);
    for (auto i = static_cast<std::size_t>(channel - image.channels.begin()); i < image.values.size();
         i += image.channels.size()) {
        const float share = image.values[i];
        if (!(share >= 0.0F && share <= 1.0F)) // also refuses NaN
            refuse(image, alpha.size(), ": A = " + std::to_string(share) + ": must be from 0 to 1");
        alpha.push_back(share);
    }
    return alpha;
}

// Keeps the file's attributes, and adds attributes of the tone mapping.
std::vector<ImageAttribute> attributes_of(const DecodedImage &image, const ToneMap &tone_map) {
    std::vector<ImageAttribute> attributes{{"software", "pt " + version_text()}};
    for (const ImageAttribute &each : image.attributes) {
        if (each.name == "pt.quantity")
            attributes.push_back({each.name, "tone-mapped " + attribute_text(each)});
        else if (each.name.starts_with("pt.") || each.name == "samplesPerPixel")
            attributes.push_back(each);
    }
    add_tone_map(attributes, tone_map);
    return attributes;
}

int run_tonemap(const TonemapOptions &options) {
    check(options);
    const DecodedImage image = read_image(options.input);
    const std::vector<float> radiance = radiance_of(image);
    const ImageWindow window = window_of(image);
    const ImageTarget target = image_target(options.output, options.format);
    check_image_target(target, window);

    const ToneMap tone_map = tone_map_for(display_of(options.display), radiance);
    const std::vector<ImageAttribute> attributes = attributes_of(image, tone_map);
    ImageWriter writer;
    write_display_image(writer, target, {.window = window, .attributes = attributes}, radiance, tone_map,
                        alpha_of(image, target.format));
    if (!options.quiet) {
        print_for_people("wrote " + (options.output == standard_stream ? "standard output" : options.output) + ": " +
                             window_text(window) + "\n" + automatic_exposure_line(tone_map),
                         options.output == standard_stream);
    }
    return static_cast<int>(ExitCode::done);
}

constexpr const char *tonemap_help =
    "IN is an OpenEXR file of `pt render` or another program, with the channels R, G and B. If `pt render`\n"
    "wrote IN, OUT has the pixels that it would have written with the same options. Negative numbers count\n"
    "as 0; numbers that are not finite are errors. `pt render --help` explains --exposure auto.\n";

} // namespace

void add_tonemap_command(CLI::App &program, Run &chosen) {
    const auto [command, options] =
        add_command(program, chosen, "tonemap", "Convert linear radiance to a picture, without rendering", tonemap_help,
                    &run_tonemap);
    add_text(command, "IN", options.input, "IN", "Linear radiance (.exr)")->required();
    add_text(command, "OUT", options.output, "OUT",
             "Image to write (" + extensions(is_for_displays) + "); - is standard output")
        ->required();
    constexpr auto of_radiance = std::ranges::count(image_formats, true, &ImageFormat::is_radiance);
    add_format(command, options.format, std::span(image_format_names).subspan(of_radiance));
    add_scene_options(command, options.display, false);
    add_quiet(command, options.quiet);
}

} // namespace cli
