// One rendering on a context, from a scene to the files of its picture, and how it ends.
#pragma once

#include "cli/base/context.h"
#include "cli/render/render_observer.h"
#include "cli/render/render_task.h"

#include <chrono>

namespace cli {

enum class Outcome {
    written,
    target_missed,   // all was written, but the target error was not reached
    timed_out,       // all was written, and the checkpoint has what another run can go on from
    not_all_written, // what could not is told on stderr
    interrupted,     // by a signal; the samples done so far were written, if there were any
    superseded       // nothing was written
};

// What a rendering came to that no signal has ended.
struct Ending {
    bool has_target;
    bool target_reached;
    bool timed_out; // before it ended by itself, though the target may be reached as it happens
    bool has_checkpoint;
    bool all_written;
};

// A file that is missing weighs more than samples that are; a checkpoint says that they can still be had.
constexpr Outcome outcome_of(const Ending &ending) {
    if (!ending.all_written)
        return Outcome::not_all_written;
    if (ending.timed_out && ending.has_checkpoint)
        return Outcome::timed_out;
    return ending.has_target && !ending.target_reached ? Outcome::target_missed : Outcome::written;
}

// signal: what has ended it, or came after it; 0: none.
int exit_code_of(Outcome outcome, int signal);

// For the report: when all began, and when the context began to be made ready.
struct RenderTimes {
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point create_start{};
};

// Hands scene and settings over, takes samples and writes the files. A signal stops it with the samples done so far;
// so does superseded(), but then nothing is written. Throws Failure.
Outcome render_picture(const Context &context, const RenderTask &task, const RenderTimes &times,
                       const Stop &superseded);

} // namespace cli
