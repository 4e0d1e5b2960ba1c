#include "cli/render/render_checks.h"

#include "cli/picture/picture_output.h"
#include "cli/render/source_watch.h"

#include <algorithm>
#include <filesystem>

namespace cli {
namespace {

void check_combinations(const RenderOptions &options) {
    const OutputOptions &output = options.output;
    const bool has_checkpoint = !options.checkpoint.empty();
    refuse_if(output.images.empty() && output.film.empty(), "-o or --film is missing: there is nothing to write");
    refuse_if(options.sampling == PT_SAMPLING_ADAPTIVE && !options.stopping.has_target(),
              "--sampling adaptive: needs --error");
    refuse_if(options.resume && !has_checkpoint, "--resume: needs --checkpoint");
    refuse_if(options.checkpoint_seconds && !has_checkpoint, "--checkpoint-every: needs --checkpoint");
    refuse_if(options.watch && has_checkpoint, "--checkpoint: cannot be used with --watch");
    refuse_if(options.watch && !output.film.empty(), "--film: cannot be used with --watch");
    refuse_if(options.frames && has_checkpoint,
              "--checkpoint: cannot be used with --frames; --skip-existing continues after the finished frames");
    refuse_if(options.frames && options.preview_seconds,
              "--preview-every: cannot be used with --frames, because an existing file means a finished frame");
    refuse_if(options.preview_seconds && without_standard_output(output).images.empty(),
              "--preview-every: needs -o and the name of a file");
}

void check_denoise(const RenderOptions &options) {
    if (options.denoiser.empty())
        return;
    const auto has = [&](std::uint32_t layer) { return std::ranges::count(options.output.layers, layer) > 0; };
    refuse_if(options.sampling == PT_SAMPLING_ADAPTIVE,
              "--sampling adaptive: cannot be used with --denoise, which takes equally many samples in all pixels");
    refuse_if(!options.checkpoint.empty() || !options.output.film.empty(),
              "--checkpoint, --film: cannot be used with --denoise, which needs two films; see `pt denoise`");
    refuse_if(options.preview_seconds.has_value(),
              "--preview-every: cannot be used with --denoise, which needs both halves of the samples");
    refuse_if(options.output.alpha, "--alpha: cannot be used with --denoise, which changes colors but not alpha");
    refuse_if(has(PT_QUANTITY_STANDARD_ERROR) || has(PT_QUANTITY_SAMPLE_COUNT),
              "--layers standard-error, sample-count: cannot be used with --denoise, whose error is known only for the "
              "whole picture");
}

// Refuses to overwrite a checkpoint that this run does not continue.
void check_checkpoint(const RenderOptions &options) {
    if (options.checkpoint.empty())
        return;
    std::error_code ignored;
    refuse_if(std::filesystem::exists(options.checkpoint, ignored) && !options.resume,
              "--checkpoint " + options.checkpoint + ": exists; continue from it by --resume, or remove it");
    remove_abandoned(AtomicFile::target_of(options.checkpoint).parent_path());
}

} // namespace

void check_names(const RenderOptions &options) {
    check_combinations(options);
    std::vector<NamedFile> sources{{"the scene", options.scene}};
    for (const std::filesystem::path &path : shader_files(options.shader_dir))
        sources.push_back({"the shader", path.string()});
    check_names(options.output, {});
    refuse_if(options.checkpoint == standard_stream,
              "--checkpoint -: goes to a file, not to standard output; give its name");
    check_denoise(options);
    const std::vector<NamedFile> outputs = outputs_of(options.output, options.checkpoint);
    require_distinct_files(sources, outputs);
    if (!options.shader_dir.empty())
        require_outside({"--shader-dir", options.shader_dir}, outputs);
}

void check_outputs(const RenderTask &task) {
    require_host_memory(task);
    check_files(task.options.output, task.window);
    check_checkpoint(task.options);
}

} // namespace cli
