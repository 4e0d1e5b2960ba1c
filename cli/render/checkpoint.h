// Keeps a film of the samples so far in a file, from which another run can continue.
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
    // seconds: interval between checkpoints. say: shows a message.
    Checkpoint(const Context &context, std::string path, double seconds, std::function<void(const std::string &)> say);

    bool is_due() const { return Clock::now() >= due_ && !task_.is_under_way(); }

    // Writes a checkpoint if one is due. sample_count: the mean over pixels.
    void step(std::uint32_t sample_count);

    // Writes the film if the file does not have all of these samples yet. Afterwards nothing is being written. Returns
    // whether the file has all of them.
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
    std::uint32_t saved_count_ = 0;               // samples in the film that was written last or is being written
    std::uint32_t written_count_ = 0;             // samples in the file, as far as this run has written it
    bool has_told_failure_ = false;
    std::vector<std::byte> film_;
    BackgroundTask task_; // destroyed first: it uses the others
};

// Adds the checkpoint's samples; call it after pt_set_render. Returns how many samples of a pixel it had: 0 if there is
// no file yet, because an earlier run ended too early to write one. Throws Failure(ExitCode::usage) if the checkpoint
// is of another picture, and says what differs, or if it has samples that this run does not take.
std::uint32_t resume(const Context &context, const RenderTask &task);

} // namespace cli
