#include "cli/render/render_options.h"

#include "cli/base/common_options.h"
#include "cli/base/method_names.h"
#include "cli/render/picture_layer.h"

#include <algorithm>
#include <iterator>

namespace cli {
namespace {

constexpr double least_seconds = 0.01;
constexpr double most_seconds = 1e9; // thirty years

CLI::Option *add_target_error(CLI::App &command, std::optional<double> &target_error) {
    const auto read = [&target_error](const std::string &text) { target_error = read_target_error("--error", text); };
    return command
        .add_option_function<std::string>(
            "--error", read,
            "Stop at this relative error, like 0.5% or 0.005; 2 means 200% (default: take "
            "all samples)")
        ->type_name("E");
}

void add_output_options(CLI::App &command, RenderOptions &options) {
    const std::string group = "Output";
    command
        .add_option("-o,--output", options.outputs,
                    "Image to write, may be given again: .exr is linear 32-bit radiance; .png, .jpg are tone-mapped; "
                    "- is standard output")
        ->expected(1)
        ->take_all()
        ->type_name("IMAGE")
        ->group(group);
    add_format(command, options.format, image_format_names)->group(group);
    command
        .add_option("--standard-error", options.standard_error,
                    "Write the standard error of every pixel (.exr), estimated from two parts of its samples")
        ->type_name("EXR")
        ->group(group);
    const auto read_layers = [&options](const std::string &text) { options.layers = parse_layers(text); };
    command
        .add_option_function<std::string>("--layers", read_layers, "Layers of .exr beside the mean, like depth,albedo")
        ->type_name(alternatives(layer_names.names()) + ",...")
        ->group(group);
    command
        .add_flag("--alpha", options.alpha,
                  "Give .exr and .png an alpha channel: the share of a pixel's samples that see a surface")
        ->group(group);
    command
        .add_option("--stats", options.stats,
                    "Write the facts of the rendering as JSON; - is standard output, the summary then goes to stderr")
        ->type_name("JSON")
        ->group(group);
}

void add_picture_options(CLI::App &command, RenderOptions &options) {
    add_size(command, options.size)->group("Picture");
    const auto read_crop = [&options](const std::string &text) {
        options.crop = parse_rectangle(text);
        if (!options.crop)
            refuse_option("--crop", "must be four whole numbers like 10,20,640,480: x, y, width and height", text);
    };
    command
        .add_option_function<std::string>("--crop", read_crop,
                                          "Render this part of the picture alone, in pixels from its top left corner")
        ->type_name("X,Y,W,H")
        ->group("Picture");
    add_display_options(command, options.display, "the scene's, else ");
}

void add_sampling_options(CLI::App &command, RenderOptions &options) {
    const std::string group = "Samples";
    add_whole_number<std::uint32_t>(command, "--spp", options.sample_count, 1,
                                    "Samples per pixel; with --error or --time the most (default: the scene's, else "
                                    "64, with either 65536)")
        ->group(group);
    add_target_error(command, options.target_error)->group(group);
    const auto find_sampling = [](std::string_view name) { return samplings.find(name); };
    add_name(command, "--sampling", options.sampling, find_sampling, "way to sample", samplings.names(),
             "Which pixels get more samples: adaptive, which is best with --error, those where they lessen the error "
             "most; uniform none (default: best)")
        ->group(group);
    add_seed(command, options.seed)->group(group);
    add_max_path_length(command, options.max_path_length)->group(group);
    const auto find_sampler = [](std::string_view name) { return samplers.find(name); };
    add_name(command, "--sampler", options.sampler, find_sampler, "sampler", samplers.names(),
             "Where the points of samples come from; they differ in noise alone (default: the scene's, else best)")
        ->group(group);
    const auto find_estimator = [](std::string_view name) { return estimators.find(name); };
    add_name(command, "--estimator", options.estimator, find_estimator, "estimator", estimators.names(),
             "How light is looked for; they differ in noise alone (default: the scene's, else best)")
        ->group(group);
    add_real_number(command, "--time", options.time_limit, least_seconds, most_seconds,
                    "Stop after S seconds of taking samples, one sample at the least (default: take all samples)")
        ->type_name("S")
        ->group(group);
}

void add_lasting_options(CLI::App &command, RenderOptions &options) {
    const std::string group = "Checkpoints and parts";
    command
        .add_option("--checkpoint", options.checkpoint,
                    "Keep the samples so far in FILM (.ptfilm), from which --resume goes on")
        ->type_name("FILM")
        ->group(group);
    add_real_number(command, "--checkpoint-every", options.checkpoint_seconds, least_seconds, most_seconds,
                    "Write the checkpoint every S seconds, and at the end (default: 30)")
        ->type_name("S")
        ->group(group);
    command
        .add_flag("--resume", options.resume,
                  "Go on from the checkpoint, to the same bytes as without a stop; from the start if there is none yet")
        ->group(group);
    command
        .add_option("--film", options.film,
                    "Write the film (.ptfilm): the exact sums of the samples, for `pt merge`; -o may be left out then")
        ->type_name("FILM")
        ->group(group);
    add_whole_number<std::uint32_t>(command, "--first-sample", options.first_sample, 0,
                                    "Index of the first sample: parts have samples of one sequence (default: 0)")
        ->group(group);
}

// For another program, which reads standard output and makes what is refused here.
void add_parts_option(CLI::App &command, RenderOptions &options) {
    CLI::Option *parts = command.add_flag("--parts", options.parts,
                                          "Render the parts that are asked for on standard input, and write their "
                                          "films to standard output: for programs that share a picture, as pt-farm");
    parts->group("Checkpoints and parts");
    for (const char *other :
         {"--output", "--format", "--standard-error", "--layers", "--alpha", "--film", "--stats", "--crop", "--time",
          "--checkpoint", "--resume", "--preview-every", "--piece-rows", "--watch", "--skip-existing"}) {
        parts->excludes(command.get_option(other));
    }
}

void add_device_options(CLI::App &command, RenderOptions &options) {
    const std::string group = "Device";
    add_device(command, options.device)->group(group);
    add_whole_number<std::uint32_t>(command, "--submit-ms", options.submit_milliseconds, 1,
                                    "Aim for the length of one submission to the device (default: 50)")
        ->group(group);
    add_whole_number<std::uint32_t>(
        command, "--piece-rows", options.piece_rows, 1,
        "Render the image in pieces of so many rows, for less memory on the device (default: "
        "the whole, or what its memory holds)")
        ->group(group);
    command
        .add_flag("--validation", options.validation,
                  "Run with the Khronos validation layer; any message of it makes the exit code 1")
        ->group(group);
}

void add_live_options(CLI::App &command, RenderOptions &options) {
    const std::string group = "Live view and editing";
    add_real_number(command, "--preview-every", options.preview_seconds, least_seconds, most_seconds,
                    "Write the picture so far every S seconds (default: only on SIGUSR1)")
        ->type_name("S")
        ->group(group);
    command
        .add_flag("--watch", options.watch,
                  "Render again whenever the scene or a shader of --shader-dir changes, until Ctrl-C")
        ->group(group);
    command
        .add_option("--shader-dir", options.shader_dir,
                    "Compile the kernels from the GLSL files in DIR, edited copies of the project's shaders/")
        ->type_name("DIR")
        ->group(group);
}

void add_animation_options(CLI::App &command, RenderOptions &options) {
    const std::string group = "Animation";
    const auto read_frames = [&options](const std::string &text) {
        options.frames = parse_frames(text);
        if (!options.frames)
            refuse_option("--frames", "must be two whole numbers like 0-23, or one", text);
    };
    CLI::Option *frames =
        command
            .add_option_function<std::string>("--frames", read_frames,
                                              "Render these frames of the scene's animation; # signs in the names of "
                                              "files become the frame's number")
            ->type_name("A-B")
            ->group(group);
    command.add_flag("--skip-existing", options.skip_existing, "Leave out frames whose files are all there")
        ->needs(frames)
        ->group(group);
}

} // namespace

const char *const render_help =
    "The error is estimated from the image itself, once it has 16 samples: rmse is the root of the mean of (x-r)^2\n"
    "over pixels and channels for the image x and its limit r, relative_rmse the same of (x-r)^2/(r^2+0.01). The\n"
    "summary shows relative_rmse and its bounds of 95% confidence; where it cannot be known well, it is called\n"
    "uncertain, with the reason, and its bounds are wider. --error stops sampling once the upper one is at or\n"
    "below E. --stats has both with bounds (rmse_low, rmse_high, ...; null where unknown), uncertain, target_error\n"
    "(null without --error) and target_reached. --standard-error is in units of radiance, infinite with a single\n"
    "sample.\n\n"
    "--exposure auto brings the average of the picture to middle grey, 0.18 (Reinhard et al. 2002): the exponential of "
    "the\n"
    "mean of the logarithms of its pixels, each the mean of its three channels; black ones do not count. It is rounded "
    "to\n"
    "hundredths and shown, so that it can be given as a number where pictures are to be compared.\n\n"
    "A file that cannot be written whole is left as it was. The metadata of images say what made them, and no time:\n"
    "equal runs give equal files. SOURCE_DATE_EPOCH, in seconds since 1970, gives them a date.\n\n"
    "With --watch, what is wrong with a scene, its data or a shader is told once, and the picture stays as it was "
    "until that is\n"
    "mended. A change stops the rendering under way. Sources that give the same kernels and scene render nothing.\n";

void add_render_options(CLI::App &command, RenderOptions &options) {
    command.add_option("SCENE", options.scene, "Scene file (JSON); - is standard input")
        ->required()
        ->type_name("SCENE");
    add_output_options(command, options);
    const auto read_overrides = [&options](const std::vector<std::string> &texts) {
        options.overrides.clear();
        std::transform(texts.begin(), texts.end(), std::back_inserter(options.overrides), &parse_override);
    };
    command
        .add_option_function<std::vector<std::string>>(
            "--set", read_overrides,
            "A value in place of the scene's, like camera.vertical_fov=30 or spheres[0].radius=2; may be given again")
        ->expected(1)
        ->take_all()
        ->type_name("PATH=VALUE")
        ->group("Picture");
    add_picture_options(command, options);
    add_sampling_options(command, options);
    add_lasting_options(command, options);
    add_animation_options(command, options);
    add_device_options(command, options);
    add_live_options(command, options);
    add_parts_option(command, options);
    add_reporting(command, options.progress, options.quiet);
}

} // namespace cli
