// Decides when a scene has been rendered for so long that a kernel of its own pays. No clock and no device in here:
// TracePipelines asks, and says what became of it.
#pragma once

#include <algorithm>

namespace pt {

// A kernel of a scene's own takes about 0.3 s to build and then saves about a third of the time, so that it pays after
// a second. Waiting just that long costs at most twice what knowing the future would (the ski rental problem), for a
// single scene. Of a camera that moves and stops again and again, though, each stop may be a little longer than that.
// So the wait doubles with each kernel that was left before it had paid, and falls back with the first that has: the
// kernels that were built in vain grow with the logarithm of the time, and once the wait has reached its limit they
// take a hundredth of it.
class OwnKernelClock {
public:
    static constexpr double seconds_to_pay = 1.0;
    static constexpr double longest_wait = 32.0;

    // Whether a scene that has been rendered for so long is to get one.
    bool is_time(double seconds) const { return seconds > wait_; }

    // A kernel was left after so many seconds of use, by a scene that took the place of its own.
    void left_after(double seconds) {
        wait_ = seconds < seconds_to_pay ? std::min(2.0 * wait_, longest_wait) : seconds_to_pay;
    }

private:
    double wait_ = seconds_to_pay;
};

} // namespace pt
