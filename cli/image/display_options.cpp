#include "cli/image/display_options.h"

#include "cli/base/common_options.h"

namespace cli {

void add_display_options(CLI::App &command, DisplayOptions &options, const std::string &otherwise) {
    const std::string group = "Display (.png and .jpg only)";
    const auto read_exposure = [&options](const std::string &text) {
        options.exposure = parse_exposure(text);
        if (!options.exposure)
            refuse_option("--exposure", "must be a number from -64 to 64, or auto", text);
    };
    command
        .add_option_function<std::string>("--exposure", read_exposure,
                                          "Brighten by EV stops; auto: see below (default: " + otherwise + "auto)")
        ->type_name("EV|auto")
        ->group(group);
    add_name(command, "--tonemap", options.tone_curve, &find_tone_curve, "tone map", tone_curve_names,
             "Tone curve; none cuts off at white (default: " + otherwise + "none)")
        ->group(group);
    add_real_number(command, "--gamma", options.gamma, least_gamma, largest_gamma,
                    "Encode with the power 1/G in place of the sRGB curve (default: " + otherwise + "the sRGB curve)")
        ->type_name("G")
        ->group(group);
    const auto read_bits = [&options](const std::string &text) {
        if (text != "8" && text != "16")
            refuse_option("--png-bits", "must be 8 or 16", text);
        options.png_bits = text == "8" ? 8 : 16;
    };
    command.add_option_function<std::string>("--png-bits", read_bits, "Bits of a channel in .png (default: 8)")
        ->type_name("8|16")
        ->group(group);
}

CLI::Option *add_format(CLI::App &command, std::optional<ImageFormat> &format,
                        std::span<const std::string_view> names) {
    return add_name(command, "--format", format, &find_image_format, "format", names,
                    "Format of the image that goes to standard output");
}

} // namespace cli
