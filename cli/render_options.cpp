// Owns the options of `pt render`: their names, help and syntax.
// Called by main; read by render_command and render_settings.
#include "render_options.h"

#include "estimator.h"
#include "suggestion.h"

#include <array>
#include <limits>
#include <span>
#include <string_view>

namespace cli {
namespace {

// CLI11 would read "-1" as the largest unsigned number and "010" as 8, so numbers are read here.
[[noreturn]] void refuse(const std::string &option, const std::string &rule, const std::string &text) {
    throw CLI::ValidationError(option, rule + ", is \"" + text + "\"");
}

template <typename Number, typename Target>
CLI::Option *add_whole_number(CLI::App &command, const std::string &name, Target &target, Number smallest,
                              const std::string &help) {
    const auto read = [&target, name, smallest](const std::string &text) {
        const auto number = parse_number<Number>(text);
        if (!number || *number < smallest) {
            refuse(name,
                   "must be a whole number from " + std::to_string(smallest) + " to " +
                       std::to_string(std::numeric_limits<Number>::max()),
                   text);
        }
        target = *number;
    };
    return command.add_option_function<std::string>(name, read, help);
}

template <typename Target>
CLI::Option *add_real_number(CLI::App &command, const std::string &name, Target &target, double smallest,
                             double largest, const std::string &help) {
    const auto read = [&target, name, smallest, largest](const std::string &text) {
        const auto number = parse_number<double>(text);
        if (!number || *number < smallest || *number > largest) {
            refuse(name,
                   "must be a number from " + CLI::detail::to_string(smallest) + " to " +
                       CLI::detail::to_string(largest),
                   text);
        }
        target = *number;
    };
    return command.add_option_function<std::string>(name, read, help);
}

template <typename Target, typename Find>
CLI::Option *add_name(CLI::App &command, const std::string &name, Target &target, Find find, const std::string &kind,
                      std::span<const std::string_view> known, const std::string &help) {
    const auto read = [&target, find, name, kind, known](const std::string &text) {
        const auto found = find(text);
        if (!found) {
            throw CLI::ValidationError(name, unknown_name(kind, text, known));
        }
        target = *found;
    };
    return command.add_option_function<std::string>(name, read, help);
}

void add_output_options(CLI::App &command, RenderOptions &options) {
    command
        .add_option("-o,--output", options.outputs,
                    "Image to write, may be given again: .exr is linear 32-bit radiance; .png, .jpg are tone-mapped")
        ->required()
        ->expected(1)
        ->take_all()
        ->type_name("FILE");
    command.add_option("--stats", options.stats, "Write the facts of the rendering as JSON")->type_name("FILE");
}

void add_picture_options(CLI::App &command, RenderOptions &options) {
    command
        .add_option_function<std::string>(
            "--size",
            [&options](const std::string &text) {
                options.size = parse_size(text);
                if (!options.size) {
                    refuse("--size", "must be two whole numbers like 1920x1080", text);
                }
            },
            "Pixels (default: the scene's, else 512x512)")
        ->type_name("WxH")
        ->group("Picture");
    add_real_number(command, "--exposure", options.tone_map.exposure, -64.0, 64.0,
                    "Brighten by EV stops; .png and .jpg only (default: 0)")
        ->type_name("EV")
        ->group("Picture");
    add_name(command, "--tonemap", options.tone_map.curve, &find_tone_curve, "tone map", tone_curve_names,
             "none (clamp; the default), reinhard, aces, agx, neutral; .png and .jpg only")
        ->type_name("NAME")
        ->group("Picture");
    add_real_number(command, "--gamma", options.tone_map.gamma, 0.1, 10.0,
                    "Encode with the power 1/G in place of the sRGB curve; .png and .jpg only")
        ->type_name("G")
        ->group("Picture");
}

void add_sampling_options(CLI::App &command, RenderOptions &options) {
    const std::string group = "Sampling";
    add_whole_number<std::uint32_t>(command, "--spp", options.sample_count, 1,
                                    "Samples per pixel (default: the scene's, else 64)")
        ->type_name("N")
        ->group(group);
    add_whole_number<std::uint64_t>(command, "--seed", options.seed, 0, "Seed (default: the scene's, else 0)")
        ->type_name("N")
        ->group(group);
    add_whole_number<std::uint32_t>(command, "--first-sample", options.first_sample, 0,
                                    "Index of the first sample, to continue a sequence (default: 0)")
        ->type_name("N")
        ->group(group);
    add_whole_number<std::uint32_t>(command, "--max-path-length", options.max_path_length, 1,
                                    "Surface vertices after the camera, 1 = emission only (default: the scene's, "
                                    "else 6)")
        ->type_name("L")
        ->group(group);
    add_name(command, "--estimator", options.estimator, &find_estimator, "estimator", estimator_names,
             "best, uniform, mis; they differ in noise alone (default: the scene's, else best)")
        ->type_name("NAME")
        ->group(group);
}

void add_device_options(CLI::App &command, RenderOptions &options) {
    const std::string group = "Device";
    command
        .add_option("--device", options.device,
                    "Index or UUID from `pt devices`, part of a name, gpu or cpu (default: the best one)")
        ->type_name("D")
        ->group(group);
    add_whole_number<std::uint32_t>(command, "--submit-ms", options.submit_milliseconds, 1,
                                    "Aim for the length of one submission to the device (default: 50)")
        ->type_name("N")
        ->group(group);
    command
        .add_flag("--validation", options.validation,
                  "Run with the Khronos validation layer; any message of it makes the exit code 1")
        ->group(group);
}

void add_reporting_options(CLI::App &command, RenderOptions &options) {
    const std::string group = "Reporting";
    static constexpr std::array<std::string_view, 3> styles{"auto", "json", "none"};
    command
        .add_option_function<std::string>(
            "--progress",
            [&options](const std::string &text) {
                if (std::find(styles.begin(), styles.end(), text) == styles.end()) {
                    throw CLI::ValidationError("--progress", unknown_name("style", text, styles));
                }
                options.progress = text;
            },
            "On stderr: auto (a line if it is a terminal; the default), json (an object a line), none")
        ->type_name("STYLE")
        ->group(group);
    command.add_flag("-q,--quiet", options.quiet, "Print errors only")->group(group);
}

} // namespace

void add_render_options(CLI::App &command, RenderOptions &options) {
    command.add_option("scene", options.scene, "Scene file (JSON)")->required()->type_name("SCENE");
    add_output_options(command, options);
    add_picture_options(command, options);
    add_sampling_options(command, options);
    add_device_options(command, options);
    add_reporting_options(command, options);
}

} // namespace cli
