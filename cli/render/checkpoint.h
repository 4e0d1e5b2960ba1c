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
    Checkpoint(const Context &context, std::string path, double seconds, std::function<void(const std::string &)> say);

    bool is_due() const { return Clock::now() >= due_ && !task_.is_under_way(); }

    // `sample_count` is the mean over pixels.
    void step(std::uint32_t sample_count);

    // Writes the last samples and waits. Returns whether the file has all samples.
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
    std::chrono::duration<double> write_time_{0};
    std::uint32_t saved_count_ = 0;   // samples in the latest film, which may not be written yet
    std::uint32_t written_count_ = 0; // samples in the file
    bool has_told_failure_ = false;
    std::vector<std::byte> film_;
    BackgroundTask task_; // destroyed first, because it uses the other members
};

// Must follow pt_set_render. Returns the added samples per pixel, 0 without a file. Throws Failure(ExitCode::usage),
// with the differences, if the checkpoint has another picture or unwanted samples.
std::uint32_t resume(const Context &context, const RenderTask &task);

} // namespace cli
