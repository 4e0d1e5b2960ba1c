#include "cli/render/render_command.h"

#include "cli/base/exit_code.h"
#include "cli/base/interrupt.h"
#include "cli/base/message.h"
#include "cli/base/vector_width.h"
#include "cli/render/frames_command.h"
#include "cli/render/parts_command.h"
#include "cli/render/render_context.h"
#include "cli/render/render_output.h"
#include "cli/render/render_picture.h"
#include "cli/render/watch_command.h"
#include "cli/scene/render_settings.h"
#include "cli/scene/scene_file.h"

#include <chrono>
#include <optional>

namespace cli {
namespace {

int render_once(const RenderOptions &options, ValidationLog &log) {
    RenderTimes times{};
    times.start = std::chrono::steady_clock::now();
    if (!options.parts)
        check_names(options);
    SceneFile file = read_scene(options);
    complete_scene(options, file);
    const RenderSettings settings = merge_settings(options, file);
    if (options.parts)
        return render_parts(options, file, settings, log);
    check_outputs(options, settings);
    catch_interrupts();
    catch_picture_requests();
    choose_vector_width();

    times.create_start = std::chrono::steady_clock::now();
    const Context context(render_create_info(options, log));
    const Outcome outcome = render_picture(context, options, file, settings, times, [] { return false; });
    return exit_code_of(outcome, interrupt_signal());
}

} // namespace

int run_render(const RenderOptions &options) {
    ValidationLog log;
    const int code = options.watch    ? watch(options, log)
                     : options.frames ? render_frames(options, log)
                                      : render_once(options, log);
    // Only now, for the layer reports leaks when the context goes.
    return log.count > 0 ? static_cast<int>(ExitCode::internal) : code;
}

} // namespace cli
