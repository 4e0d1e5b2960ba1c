// Reports the progress of a long call to the caller's pt_progress_fn. The call is a sequence of stages.
#pragma once

#include <pt/pt.h>

#include <algorithm>
#include <cstddef>

namespace pt {

// Thrown if the caller asked to stop. The call returns PT_CANCELLED.
struct Cancelled {};

class WorkProgress {
public:
    WorkProgress() = default;

    WorkProgress(pt_progress_fn function, void *user) : function_(function), user_(user) {}

    WorkProgress(const WorkProgress &) = delete;
    WorkProgress &operator=(const WorkProgress &) = delete;

    // Begins a stage. share_of_rest is its fraction of the remaining call, work its amount of work in any unit.
    void enter(double share_of_rest, double work) {
        begin_ = end_; // the previous stage counts as done
        end_ += share_of_rest * (1.0 - end_);
        work_ = work;
        done_ = 0.0;
    }

    // Adds finished work. Reports after elements_between_calls elements.
    void add(double work, std::size_t elements) {
        done_ += work;
        untold_ += elements;
        if (untold_ >= elements_between_calls)
            tell();
    }

    void add(std::size_t elements) { add(static_cast<double>(elements), elements); }

    // Reports 1. After this the call must not fail.
    void finish() {
        enter(1.0, 1.0);
        done_ = 1.0;
        tell();
    }

private:
    // This many elements take about a millisecond.
    static constexpr std::size_t elements_between_calls = std::size_t{1} << 17;

    void tell() {
        untold_ = 0;
        const double share = work_ > 0.0 ? std::clamp(done_ / work_, 0.0, 1.0) : 0.0;
        if (function_ && function_(user_, begin_ + (end_ - begin_) * share) != 0)
            throw Cancelled();
    }

    pt_progress_fn function_ = nullptr;
    void *user_ = nullptr;
    double begin_ = 0.0; // the stage goes from begin_ to end_, fractions of the call
    double end_ = 0.0;
    double work_ = 1.0;
    double done_ = 0.0; // finished part of work_
    std::size_t untold_ = 0;
};

} // namespace pt
