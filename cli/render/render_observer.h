// The interface between the render loop and what looks at an image while it is rendered: progress, rules that stop it,
// and whatever comes next, each in a file of its own.
#pragma once

#include <pt/stats.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>

namespace cli {

// Says that no more samples are to be taken: a signal has come, or nothing would become of them. True for good then.
using Stop = std::function<bool()>;

struct PiecewiseImage;

// After a step.
struct RenderState {
    std::uint32_t sample_count; // of a pixel on the average, rounded
    std::chrono::steady_clock::time_point time;
    bool has_ended;        // with the target error, or with all samples
    const pt_stats *stats; // with the stated error; NULL if no observer needs it
    double stats_seconds;  // what reading them took
};

class RenderObserver {
public:
    using Clock = std::chrono::steady_clock;

    RenderObserver() = default;
    RenderObserver(const RenderObserver &) = delete;
    RenderObserver &operator=(const RenderObserver &) = delete;
    virtual ~RenderObserver() = default;

    // From now on a piece of so many rows is rendered. before: the pieces that are done; it stays where it is until all
    // are.
    virtual void enter(const PiecewiseImage & /*before*/, std::uint32_t /*rows*/) {}

    // With how many samples the present step has to end at the latest, where sample_count are done.
    virtual std::uint32_t next_end(std::uint32_t /*sample_count*/) const {
        return std::numeric_limits<std::uint32_t>::max();
    }

    // Whether the step is to end as soon as it has a whole sample, so that stepped() sees it.
    virtual bool pauses() const { return false; }

    // Whether the stated error is wanted after the step, which takes a read-out of the image.
    virtual bool needs_error() const { return false; }

    // Within a step, after each submission: samples that are done, in parts too.
    virtual void submitted(double /*sample_count*/, Clock::time_point /*time*/) {}

    virtual void stepped(const RenderState & /*state*/) {}

    // Whether no more samples are to be taken. Asked before the first and after each submission.
    virtual bool stops() const { return false; }
};

// Ends a rendering when it is told to.
class StopObserver : public RenderObserver {
public:
    explicit StopObserver(Stop stop) : stop_(std::move(stop)) {}
    bool stops() const override { return stop_(); }

private:
    Stop stop_;
};

} // namespace cli
