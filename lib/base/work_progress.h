// Reports a long call's progress, a sequence of stages, to the caller's pt_progress_fn, which may cancel it.
#pragma once

#include <pt/pt.h>

#include <algorithm>
#include <cstddef>

namespace pt {

// The call returns PT_CANCELLED.
struct Cancelled {};

class WorkProgress {
public:
    // Reports to nobody.
    WorkProgress() = default;

    // function may be NULL.
    WorkProgress(pt_progress_fn function, void *user) : function_(function), user_(user) {}

    WorkProgress(const WorkProgress &) = delete;
    WorkProgress &operator=(const WorkProgress &) = delete;

    // share_of_rest: the stage's share of the remaining whole. work: its amount, in any unit.
    void enter(double share_of_rest, double work) {
        begin_ = end_; // a stage that ended early counts as done
        end_ += share_of_rest * (1.0 - end_);
        work_ = work;
        done_ = 0.0;
    }

    // elements decide when to report.
    void add(double work, std::size_t elements) {
        done_ += work;
        untold_ += elements;
        if (untold_ >= elements_between_calls)
            tell();
    }

    void add(std::size_t elements) { add(static_cast<double>(elements), elements); }

    // Reports 1: the rest cannot fail.
    void finish() {
        enter(1.0, 1.0);
        done_ = 1.0;
        tell();
    }

private:
    // These take between half a millisecond and several.
    static constexpr std::size_t elements_between_calls = std::size_t{1} << 17;

    void tell() {
        untold_ = 0;
        const double share = work_ > 0.0 ? std::clamp(done_ / work_, 0.0, 1.0) : 0.0;
        if (function_ && function_(user_, begin_ + (end_ - begin_) * share) != 0)
            throw Cancelled();
    }

    pt_progress_fn function_ = nullptr;
    void *user_ = nullptr;
    double begin_ = 0.0; // share of the whole
    double end_ = 0.0;
    double work_ = 1.0; // the stage's work
    double done_ = 0.0; // its finished part
    std::size_t untold_ = 0;
};

} // namespace pt
