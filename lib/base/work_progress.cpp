// Reports how far a call is; see work_progress.h.
#include "lib/base/work_progress.h"

#include <algorithm>

namespace pt {

// A stage that ended early counts as done.
void WorkProgress::enter(double share_of_rest, double work) {
    begin_ = end_;
    end_ += share_of_rest * (1.0 - end_);
    work_ = work;
    done_ = 0.0;
}

void WorkProgress::finish() {
    enter(1.0, 1.0);
    done_ = 1.0;
    tell();
}

void WorkProgress::tell() {
    untold_ = 0;
    const double share = work_ > 0.0 ? std::clamp(done_ / work_, 0.0, 1.0) : 0.0;
    if (function_ && function_(user_, begin_ + (end_ - begin_) * share) != 0)
        throw Cancelled();
}

} // namespace pt
