#include "cli/render/render_options.h"

#include "cli/base/options.h"
#include "cli/base/text.h"
#include "cli/commands.h"
#include "cli/picture/picture_layer.h"
#include "cli/render/render_command.h"
#include "lib/platform/module.h"
#include "lib/scene_file/enumerations.h"

#include <algorithm>
#include <array>

namespace cli {
namespace {

// parse() returns an optional. Messages state `rule`.
template <typename Target, typename Parse>
CLI::Option *add_parsed(CLI::App &command, const std::string &name, Target &target, Parse parse,
                        const std::string &rule, const std::string &help) {
    const auto read = [&target, name, parse, rule](const std::string &text) {
        const auto value = parse(text);
        if (!value)
            refuse_option(name, rule, text);
        target = *value;
    };
    return command.add_option_function<std::string>(name, read, help);
}

template <typename Target>
CLI::Option *add_seconds(CLI::App &command, const std::string &name, Target &target, const std::string &help) {
    return add_number<double>(command, name, seconds_rule, target, help)->type_name("S");
}

void add_picture_options(CLI::App &command, RenderOptions &options) {
    command.option_defaults()->group("Picture");
    command.add_flag(concat("--denoise{", platform::denoiser_file, "}"), options.denoiser,
                     "Denoise by the library Open Image Denoise 2, and state the error of the result");
    add_parsed(command, "--crop", options.crop, &parse_rectangle,
               "must be four whole numbers like 10,20,640,480: x, y, width and height",
               "Render only this part of the picture, in pixels from its top left corner")
        ->type_name("X,Y,W,H");
}

void add_sampling_options(CLI::App &command, RenderOptions &options) {
    command.option_defaults()->group("Samples");
    const auto parse_error = [](std::string_view text) {
        const std::optional<double> share = parse_share(text);
        return share > 0.0 ? share : std::nullopt;
    };
    add_parsed(command, "--error", options.stopping.target_error, parse_error,
               "must be a number above 0 like 0.005 or 0.5%",
               "Stop at this relative error, like 0.5% or 0.005; 2 means 200% (default: take all samples)")
        ->type_name("E");
    add_name(
        command, "--sampling", options.sampling, [](std::string_view name) { return pt::samplings.find(name); },
        "way to sample", pt::samplings.names(),
        "Take the same samples in all pixels (uniform), or more where they reduce the error most (adaptive); the "
        "default, best, is adaptive with --error");
    add_seconds(command, "--time", options.stopping.time_limit,
                "Stop after S seconds of sampling, with at least one sample (default: take all samples)");
}

void add_lasting_options(CLI::App &command, RenderOptions &options) {
    command.option_defaults()->group("Checkpoints and parts");
    add_text(command, "--checkpoint", options.checkpoint, "FILM",
             "Keep the samples so far in FILM (.ptfilm), for --resume");
    add_seconds(command, "--checkpoint-every", options.checkpoint_seconds,
                "Write the checkpoint every S seconds, and at the end (default: 30)");
    command.add_flag("--resume", options.resume,
                     "Continue from the checkpoint, if there is one; the result has the same bytes as without a stop");
    add_number<std::uint32_t>(command, "--first-sample", natural_number, options.first_sample,
                              "Index of the first sample, for parts of one picture (default: 0)");
}

void add_device_options(CLI::App &command, RenderOptions &options) {
    command.option_defaults()->group("Device");
    add_device(command, options.device);
    add_number<std::uint32_t>(command, "--submit-ms", positive_number, options.submit_milliseconds,
                              "Aim for the length of one submission to the device (default: 50)");
    add_number<std::uint32_t>(
        command, "--piece-rows", positive_number, options.piece_rows,
        "Render N rows at a time, to use less memory of the device (default: all, or as many as its memory holds)");
    command.add_flag("--validation", options.validation,
                     "Run with the Khronos validation layer; exit with 1 if it reports a message");
}

void add_live_options(CLI::App &command, RenderOptions &options) {
    static constexpr std::array<std::string_view, 3> styles{"auto", "json", "none"};
    command.option_defaults()->group("Live view and editing");
    add_seconds(command, "--preview-every", options.preview_seconds,
                "Write the picture so far every S seconds (default: only on SIGUSR1)");
    command.add_flag("--watch", options.watch,
                     "Render again whenever the scene or a shader of --shader-dir changes, until Ctrl-C");
    add_shader_dir(command, options.shader_dir);
    command.option_defaults()->group("Messages");
    add_name(
        command, "--progress", options.progress, [](std::string_view name) { return std::optional(name); }, "style",
        styles, "On stderr: auto (a line if it is a terminal; the default), json (an object a line), none");
}

void add_animation_options(CLI::App &command, RenderOptions &options) {
    command.option_defaults()->group("Animation");
    CLI::Option *frames =
        add_parsed(command, "--frames", options.frames, &parse_frames, "must be two whole numbers like 0-23, or one",
                   "Render these frames of the scene's animation; # signs in file names become the frame's number")
            ->type_name("A-B");
    command.add_flag("--skip-existing", options.skip_existing, "Skip frames whose files all exist")->needs(frames);
}

constexpr const char *render_help =
    "The error is estimated from the image itself, from 16 samples on. For the image x and its limit r,\n"
    "rmse is the root of the mean of (x-r)^2 over pixels and channels, and relative_rmse the root of the\n"
    "mean of (x-r)^2/(r^2+0.01). The summary shows relative_rmse and its bounds of 95% confidence. If the\n"
    "error cannot be known well, it is called uncertain, with the reason, and its bounds are wider. --error\n"
    "stops sampling once the upper bound is at or below E. --stats has both errors with their bounds\n"
    "(rmse_low, rmse_high, ...; null where unknown), uncertain, target_error (null without --error) and\n"
    "target_reached. The layer standard-error is a radiance, and infinite with a single sample.\n\n"
    "--denoise takes half of the samples with each of two seeds, so that each half shows the filter's error\n"
    "on the other. The stated error is the result's. An .exr keeps the mean of the samples as the layer raw.\n"
    "With --error or --time it renders and denoises in rounds, each with half as many samples again.\n"
    "`pip install pyoidn` installs the library.\n\n"
    "With --error or --time, --spp is the maximum number of samples of a pixel, by default 65536.\n\n"
    "--exposure auto brings the average of the picture to middle grey, 0.18 (Reinhard et al. 2002). The\n"
    "average is the geometric mean over pixels that are not black, each the mean of its three channels.\n"
    "The exposure is rounded to hundredths and printed. To compare pictures, give them one number.\n\n"
    "If a file cannot be written, its old content stays. The metadata of images have no time, so equal\n"
    "runs give equal files.\n\n"
    "With --watch, a mistake in a scene, its data or a shader is reported once, and the picture stays until\n"
    "it is corrected. A change stops the current rendering.\n";

} // namespace

std::vector<std::uint32_t> RenderOptions::wanted_layers() const {
    std::vector<std::uint32_t> wanted = output.layers;
    if (output.alpha)
        wanted.push_back(PT_QUANTITY_COVERAGE);
    for (const std::uint32_t guide : {PT_QUANTITY_ALBEDO, PT_QUANTITY_NORMAL})
        if (!denoiser.empty() && std::ranges::find(wanted, guide) == wanted.end())
            wanted.push_back(guide);
    return wanted;
}

void add_render_command(CLI::App &program, Run &chosen) {
    const auto [command, options] =
        add_command(program, chosen, "render", "Render a scene file to images", render_help, &run_render);
    add_text(command, "SCENE", options.scene, "SCENE", "Scene file (JSON); - is standard input")->required();
    add_output_options(command, options.output, file_layers.names());
    add_scene_options(command, options.overrides, true);
    add_picture_options(command, options);
    add_sampling_options(command, options);
    add_lasting_options(command, options);
    add_animation_options(command, options);
    add_device_options(command, options);
    add_live_options(command, options);
    command.option_defaults()->group("Messages");
    add_quiet(command, options.output.quiet);
}

} // namespace cli
