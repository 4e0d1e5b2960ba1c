// The command `pt render`, with its variants --frames, --parts and --watch, and the rendering of one picture that all
// of them share.
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

// outcome: ExitCode::signal if the rendering was stopped. signal: the one that stopped it or came later; 0: none.
constexpr int exit_code_of(ExitCode outcome, int signal) {
    if (outcome != ExitCode::done && outcome != ExitCode::signal)
        return static_cast<int>(outcome);
    return signal == 0 ? static_cast<int>(ExitCode::done) : exit_code_of_signal(signal);
}

// Starts of the run and of the context's preparation, for the report.
struct RenderTimes {
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point create_start{};
};

// Sets scene, camera and settings, takes samples and writes the files. A signal stops it and keeps the samples so far;
// superseded() stops it, and then nothing is written. Throws Failure.
ExitCode render_picture(const Context &context, const RenderTask &task, const RenderTimes &times,
                        const Stop &superseded);

// Returns the exit code; throws Failure. So do the functions below.
int run_render(const RenderOptions &options);

// Counts the validation layer's messages: each shows a mistake in this program or its library.
struct ValidationLog {
    std::uint64_t count = 0;

    static void receive(void *user, std::int32_t level, const char *line) {
        if (level == PT_LOG_ERROR || level == PT_LOG_WARNING) {
            ++static_cast<ValidationLog *>(user)->count;
            print_message(std::string("validation: ") + line);
        }
    }
};

// Refers to both arguments.
pt_create_info render_create_info(const RenderOptions &options, ValidationLog &log);

// Renders parts of a picture for another program that shares it among machines, such as pt-farm.
//
// First writes a line of JSON: an object with the quantities that decide the parts (width, height, first_sample,
// samples, target_error as in pt_accumulate_info, sampling as PT_SAMPLING_*) and the display (exposure, a number or
// "auto"; tonemap; gamma, null for the sRGB curve). Then answers requests until standard input ends; the first one
// starts the device.
//
// A request has 32-bit words in the machine's byte order: first sample, sample after the last, number of tiles, and
// their indices (pt_accumulate_info.tile_samples), each once. The answer is a line with the kind of device
// (PT_DEVICE_*) and the number of bytes that follow: the film. Three words of 0 ask for the scene in the form of
// write_scene, without a device. An invalid request ends the program with ExitCode::usage.
int render_parts(const RenderTask &task, ValidationLog &log);

// Renders again, on one context, whenever the sources change. Ends after a signal; with 0 if it came while waiting.
// Throws Failure if no change of a source could help, and for the first picture if the fault is not in a scene or
// shader.
int render_watched(const RenderOptions &options, ValidationLog &log);

} // namespace cli
