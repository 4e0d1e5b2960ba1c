// Owns the options of `pt render`: their names, help and syntax.
// Called by main; read by render_command and render_settings.
#include "render_options.h"

#include "common_options.h"
#include "method_names.h"

namespace cli {
namespace {

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
    add_size(command, options.size)->group("Picture");
    add_real_number(command, "--exposure", options.tone_map.exposure, -64.0, 64.0,
                    "Brighten by EV stops; .png and .jpg only (default: 0)")
        ->type_name("EV")
        ->group("Picture");
    add_name(command, "--tonemap", options.tone_map.curve, &find_tone_curve, "tone map", tone_curve_names,
             "none (clamp; the default), reinhard, aces, agx, neutral; .png and .jpg only")
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
        ->group(group);
    add_seed(command, options.seed)->group(group);
    add_whole_number<std::uint32_t>(command, "--first-sample", options.first_sample, 0,
                                    "Index of the first sample, to continue a sequence (default: 0)")
        ->group(group);
    add_max_path_length(command, options.max_path_length)->group(group);
    const auto find_sampler = [](std::string_view name) { return samplers.find(name); };
    add_name(command, "--sampler", options.sampler, find_sampler, "sampler", samplers.names(),
             samplers.list() + "; they differ in noise alone (default: the scene's, else best)")
        ->group(group);
    const auto find_estimator = [](std::string_view name) { return estimators.find(name); };
    add_name(command, "--estimator", options.estimator, find_estimator, "estimator", estimators.names(),
             estimators.list() + "; they differ in noise alone (default: the scene's, else best)")
        ->group(group);
}

void add_device_options(CLI::App &command, RenderOptions &options) {
    const std::string group = "Device";
    add_device(command, options.device)->group(group);
    add_whole_number<std::uint32_t>(command, "--submit-ms", options.submit_milliseconds, 1,
                                    "Aim for the length of one submission to the device (default: 50)")
        ->group(group);
    command
        .add_flag("--validation", options.validation,
                  "Run with the Khronos validation layer; any message of it makes the exit code 1")
        ->group(group);
}

} // namespace

void add_render_options(CLI::App &command, RenderOptions &options) {
    command.add_option("scene", options.scene, "Scene file (JSON)")->required()->type_name("SCENE");
    add_output_options(command, options);
    add_picture_options(command, options);
    add_sampling_options(command, options);
    add_device_options(command, options);
    add_reporting(command, options.progress, options.quiet);
}

} // namespace cli
