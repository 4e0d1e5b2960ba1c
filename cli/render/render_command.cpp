#include "cli/render/render_command.h"

#include "cli/base/interrupt.h"
#include "cli/picture/denoise.h"
#include "cli/picture/picture_output.h"
#include "cli/render/render_checks.h"
#include "lib/scene_file/animation.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

namespace cli {
namespace {

// Makes the context on first use.
ExitCode render(RenderTask task, RenderTimes times, std::optional<Context> &context, ValidationLog &log) {
    task.load();
    check_outputs(task);
    times.create_start = std::chrono::steady_clock::now();
    if (!context) {
        catch_signals();
        context.emplace(render_create_info(task.options, log), kernel_use(task));
    }
    return render_picture(*context, task, times, [&] { return task.options.frames && interrupt_signal() != 0; });
}

int render_once(const RenderOptions &options, ValidationLog &log) {
    const RenderTimes times;
    check_names(options);
    std::optional<Context> context;
    RenderTask task(options, read_scene_file(options.scene, options.overrides));
    const ExitCode outcome = render(std::move(task), times, context, log);
    return exit_code_of(outcome, interrupt_signal());
}

RenderOptions options_of_frame(const RenderOptions &options, std::uint32_t frame) {
    RenderOptions numbered = options;
    for_each_output(numbered.output, [&](const char *option, std::string &path) {
        const std::optional<std::string> name = numbered_name(path, frame);
        refuse_if(!name && !path.empty(), concat(option, " ", path,
                                                 ": with --frames the name needs # signs for the "
                                                 "frame's number"));
        path = name.value_or("");
    });
    return numbered;
}

// Files are written atomically, so a file that exists is complete.
bool is_done(const OutputOptions &frame) {
    return std::ranges::all_of(outputs_of(frame), [](const NamedFile &file) {
        std::error_code ignored;
        return file.path.empty() || std::filesystem::exists(file.path, ignored);
    });
}

// Each frame has its own seed, because equal noise in all frames would look like a fixed pattern.
int render_frames(const RenderOptions &options, ValidationLog &log) {
    const SceneFile scene = read_scene_file(options.scene, options.overrides);
    refuse_if(scene.animation.empty(), scene.path + ": has no animation, which --frames needs", ExitCode::scene);
    std::optional<Context> context;
    ExitCode result = ExitCode::done;
    const auto [first, last] = options.frames.value();
    for (std::uint64_t frame = first; frame <= last; ++frame) {
        const auto number = static_cast<std::uint32_t>(frame);
        const RenderOptions numbered = options_of_frame(options, number);
        if (options.skip_existing && is_done(numbered.output))
            continue;
        const RenderTimes times;
        check_names(numbered);
        RenderTask task(numbered, with_exit_code([&] { return pt::scene_in_frame(scene, number); }));
        const ExitCode outcome = render(std::move(task), times, context, log);
        if (outcome == ExitCode::file)
            return static_cast<int>(ExitCode::file);
        if (interrupt_signal() != 0) {
            print_message(concat("stopped by ", interrupt_name(), " in frame ", number));
            return exit_code_of_signal(interrupt_signal());
        }
        if (outcome == ExitCode::target_missed)
            result = outcome;
    }
    return static_cast<int>(result);
}

} // namespace

KernelUse kernel_use(const RenderTask &task) {
    const std::uint64_t pixels = std::uint64_t{task.render.width} * task.render.height;
    return {gets_tree(task.scene), pixels * task.sample_count};
}

pt_create_info render_create_info(const RenderOptions &options, ValidationLog &log) {
    pt_create_info info = create_info(options.device, options.shader_dir);
    info.submit_milliseconds = options.submit_milliseconds;
    if (options.validation) {
        info.flags = PT_CREATE_VALIDATION;
        info.log = &ValidationLog::receive;
        info.log_user = &log;
    }
    return info;
}

int run_render(const RenderOptions &options) {
    if (!options.denoiser.empty())
        require_denoiser(options.denoiser);
    ValidationLog log;
    const int code = options.watch    ? render_watched(options, log)
                     : options.frames ? render_frames(options, log)
                                      : render_once(options, log);
    // The layer reports leaks when the context is destroyed.
    return log.count > 0 ? static_cast<int>(ExitCode::internal) : code;
}

} // namespace cli
