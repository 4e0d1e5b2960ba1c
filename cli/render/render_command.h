#pragma once

#include "cli/base/context.h"
#include "cli/base/text.h"
#include "cli/render/image_render.h"
#include "cli/render/render_task.h"

#include <pt/pt.h>

#include <chrono>
#include <cstdint>
#include <string>

namespace cli {

constexpr int exit_code_of(ExitCode outcome, int signal) {
    if (outcome != ExitCode::done && outcome != ExitCode::signal)
        return static_cast<int>(outcome);
    return signal == 0 ? static_cast<int>(ExitCode::done) : exit_code_of_signal(signal);
}

struct RenderTimes {
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point create_start{};
};

// A signal ends the rendering early and keeps the samples. If superseded() is true, nothing is written. Throws Failure.
ExitCode render_picture(const Context &context, const RenderTask &task, const RenderTimes &times,
                        const Stop &superseded);

// Throws Failure.
int run_render(const RenderOptions &options);

// Counts validation messages, which show mistakes of the program or the library.
struct ValidationLog {
    std::uint64_t count = 0;

    static void receive(void *user, std::int32_t level, const char *line) {
        if (level == PT_LOG_ERROR || level == PT_LOG_WARNING) {
            ++static_cast<ValidationLog *>(user)->count;
            print_message(std::string("validation: ") + line);
        }
    }
};

KernelUse kernel_use(const RenderTask &task);

pt_create_info render_create_info(const RenderOptions &options, ValidationLog &log);

// Renders again on one context whenever a source changes, until a signal. Returns 0 if the signal comes during a wait.
// Throws Failure if no edit of a source could help.
int render_watched(const RenderOptions &options, ValidationLog &log);

} // namespace cli
