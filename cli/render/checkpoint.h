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
    // seconds: between two checkpoints. say: shows a message.
    Checkpoint(const Context &context, std::string path, double seconds, std::function<void(const std::string &)> say);

    bool is_due() const { return Clock::now() >= due_ && !task_.is_under_way(); }

    // Writes a checkpoint if one is due. sample_count: the mean over pixels.
    void step(std::uint32_t sample_count);

    // Writes those of these samples, if any, that the file does not have yet. Afterwards nothing is under way. Returns
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
    std::chrono::duration<double> write_time_{0}; // of the last one
    std::uint32_t saved_count_ = 0;               // samples of the film that was written last, or is being written
    std::uint32_t written_count_ = 0;             // samples in the file, as far as this run has written it
    bool has_told_failure_ = false;
    std::vector<std::byte> film_;
    BackgroundTask task_; // destroyed first: it uses the others
};

// After pt_set_render. Returns how many samples a pixel there were: 0 if there is no such file yet, as where the run
// before was ended too early to write one. Throws Failure(ExitCode::usage) if the checkpoint is of another picture,
// which says what differs, or has samples that this run does not take.
std::uint32_t resume(const Context &context, const RenderTask &task);

} // namespace cli
