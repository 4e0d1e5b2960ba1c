#include "cli/render/render_command.h"

#include "cli/base/interrupt.h"
#include "cli/base/vector_width.h"
#include "cli/render/render_output.h"
#include "cli/render/render_picture.h"

namespace cli {
namespace {

int render_once(const RenderOptions &options, ValidationLog &log) {
    RenderTimes times;
    if (!options.parts)
        check_names(options);
    const SceneText text = read_scene_text(options.scene);
    RenderTask task(options, parse_scene(text.text, text.path, options.overrides));
    task.load();
    if (options.parts)
        return render_parts(task, log);
    check_outputs(task);
    catch_interrupts();
    catch_picture_requests();
    choose_vector_width();

    times.create_start = std::chrono::steady_clock::now();
    const Context context(render_create_info(options, log));
    const Outcome outcome = render_picture(context, task, times, [] { return false; });
    return exit_code_of(outcome, interrupt_signal());
}

} // namespace

pt_create_info render_create_info(const RenderOptions &options, ValidationLog &log) {
    const auto text = [](const std::string &option) { return option.empty() ? nullptr : option.c_str(); };
    auto info = sized<pt_create_info>();
    info.device = text(options.device);
    info.shader_dir = text(options.shader_dir);
    info.submit_milliseconds = options.submit_milliseconds;
    if (options.validation) {
        info.flags = PT_CREATE_VALIDATION;
        info.log = &ValidationLog::receive;
        info.log_user = &log;
    }
    return info;
}

int run_render(const RenderOptions &options) {
    ValidationLog log;
    const int code = options.watch    ? render_watched(options, log)
                     : options.frames ? render_frames(options, log)
                                      : render_once(options, log);
    // Only now, for the layer reports leaks when the context goes.
    return log.count > 0 ? static_cast<int>(ExitCode::internal) : code;
}

} // namespace cli
