// The command `pt render`: scene file and options in, images out. Declares its variants --frames, --parts and --watch,
// and how all of them render one picture on a context.
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

// outcome: ExitCode::signal for a stopped rendering. signal: the one that stopped it or came later; 0: none.
constexpr int exit_code_of(ExitCode outcome, int signal) {
    if (outcome != ExitCode::done && outcome != ExitCode::signal)
        return static_cast<int>(outcome);
    return signal == 0 ? static_cast<int>(ExitCode::done) : exit_code_of_signal(signal);
}

// For the report: when everything began, and when the preparation of the context began.
struct RenderTimes {
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point create_start{};
};

// Sets scene, camera and settings, takes samples and writes the files. A signal stops it with the samples so far; so
// does superseded(), but then nothing is written. Returns how it ended. Throws Failure.
ExitCode render_picture(const Context &context, const RenderTask &task, const RenderTimes &times,
                        const Stop &superseded);

// Returns the exit code; throws Failure. So do the functions below.
int run_render(const RenderOptions &options);

// Messages of the validation layer. Each means a mistake in this program or its library.
struct ValidationLog {
    std::uint64_t count = 0;

    static void receive(void *user, std::int32_t level, const char *line) {
        if (level == PT_LOG_ERROR || level == PT_LOG_WARNING) {
            ++static_cast<ValidationLog *>(user)->count;
            print_message(std::string("validation: ") + line);
        }
    }
};

// The pt_create_info that the options ask for. It refers to both arguments.
pt_create_info render_create_info(const RenderOptions &options, ValidationLog &log);

// Renders parts of a picture for another program, which shares it among machines and adds their films, as pt-farm does.
//
// First writes one line to standard output: an object of JSON with what decides which parts there are (width, height,
// first_sample, samples, target_error as in pt_accumulate_info, sampling as PT_SAMPLING_*) and how the picture is shown
// (exposure, a number or "auto"; tonemap; gamma, null for the sRGB curve). Then answers requests until standard input
// ends; without any, no device is looked for.
//
// A request consists of 32-bit words in the machine's byte order: the first sample, the sample after the last, the
// number of tiles, and their indices (pt_accumulate_info.tile_samples), each once. Its answer is a line with two
// numbers, the kind of device (PT_DEVICE_*) and the bytes that follow: the film. Three words of 0 ask for the scene, as
// write_scene has it, without a device. An invalid request ends the program with ExitCode::usage.
int render_parts(const RenderTask &task, ValidationLog &log);

// Renders the picture again, on one context, whenever its sources change. Ends when a signal has come; with 0 if it
// came while waiting. Throws Failure if no change of a source could help, and for the first picture if the fault is not
// in a scene or shader.
int render_watched(const RenderOptions &options, ValidationLog &log);

} // namespace cli
