// The command `pt render`: scene file and options in, images out; and its other ways, of --frames, --parts and --watch.
#pragma once

#include "cli/base/message.h"
#include "cli/render/render_task.h"

#include <pt/pt.h>

#include <cstdint>
#include <string>

namespace cli {

// All return the exit code, and throw Failure.
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

// What the options say about the context. Refers to both.
pt_create_info render_create_info(const RenderOptions &options, ValidationLog &log);

// The frames of an animation, one after the other on one context. A frame that a signal stops is not written: each file
// is a whole frame.
int render_frames(const RenderOptions &options, ValidationLog &log);

// Renders parts of a picture for another program, which shares it among machines and adds their films, as pt-farm does.
//
// First writes one line to standard output: an object of JSON with what decides which parts there are (width, height,
// first_sample, samples, target_error as in pt_accumulate_info, sampling as PT_SAMPLING_*) and how the picture is shown
// (exposure, a number or "auto"; tonemap; gamma, null for the sRGB curve). Then answers requests until standard input
// ends; without any, no device is looked for.
//
// A request is words of 32 bits in the machine's byte order: the first sample, the sample after the last, the number of
// tiles, and their indices (pt_accumulate_info.tile_samples), each once. Its answer is a line with two numbers, the
// kind of device (PT_DEVICE_*) and the bytes that follow: the film. A request that makes no sense is ExitCode::usage.
int render_parts(const RenderTask &task, ValidationLog &log);

// The picture is rendered again whenever its sources change, on one context. Ends when a signal has come: with 0 if it
// came while waiting. Throws Failure where no change of a source could help, and for the first picture where the fault
// is not in a scene or shader.
int render_watched(const RenderOptions &options, ValidationLog &log);

} // namespace cli
