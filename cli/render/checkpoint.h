// Keeps a film of the samples so far in a file, for another run to continue.
#pragma once

#include "cli/base/context.h"
#include "cli/base/tasks.h"
#include "cli/render/render_task.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace cli {

class Checkpoint {
public:
    // seconds: between checkpoints; say: shows a message.
    Checkpoint(const Context &context, std::string path, double seconds, std::function<void(const std::string &)> say);

    bool is_due() const { return Clock::now() >= due_ && !task_.is_under_way(); }

    // Writes a checkpoint if due. sample_count: mean over pixels.
    void step(std::uint32_t sample_count);

    // Writes the film unless the file has all of these samples, and waits for it. Returns whether the file has all.
    bool finish(std::uint32_t sample_count);

private:
    using Clock = std::chrono::steady_clock;

    void save(std::uint32_t sample_count);
    void write();
    void take_in();
    void tell_failure(const std::string &reason);

    const Context &context_;
    std::string path_;
    std::chrono::duration<double> interval_;
    std::function<void(const std::string &)> say_;
    Clock::time_point due_;
    Clock::time_point saved_at_;
    std::chrono::duration<double> write_time_{0}; // of the last checkpoint
    std::uint32_t saved_count_ = 0;               // in the film that was written last or is being written
    std::uint32_t written_count_ = 0;             // in the file, written by this run
    bool has_told_failure_ = false;
    std::vector<std::byte> film_;
    BackgroundTask task_; // destroyed first: it uses the others
};

// Adds the checkpoint's samples, after pt_set_render. Returns its samples per pixel, 0 without a file, as an earlier
// run may have ended too early. Throws Failure(ExitCode::usage), and says what differs, if the checkpoint is of another
// picture or has samples that this run does not take.
std::uint32_t resume(const Context &context, const RenderTask &task);

} // namespace cli
