// Decides when a scene has been rendered long enough for a kernel of its own to pay. It knows neither a clock nor a
// device: TracePipelines asks it, and reports what happened.
#pragma once

#include <algorithm>

namespace pt {

// A kernel for one scene takes about 0.3 s to build and then saves about a third of the time, so it pays after a
// second. To wait for just that long costs at most twice what knowing the future would (the ski rental problem), for a
// single scene. But a camera that stops again and again may stay a little longer than that each time. So the wait
// doubles whenever a kernel was left before it had paid, and falls back when one has paid. The number of kernels built
// in vain then grows with the logarithm of the time, and once the wait has reached its limit they take a hundredth of
// it.
class OwnKernelClock {
public:
    static constexpr double seconds_to_pay = 1.0;
    static constexpr double longest_wait = 32.0;

    // Whether a scene that has been rendered for this long gets a kernel of its own.
    bool is_time(double seconds) const { return seconds > wait_; }

    // Reports that the own kernel of a scene was used for this many seconds, until another scene took its place.
    void left_after(double seconds) {
        wait_ = seconds < seconds_to_pay ? std::min(2.0 * wait_, longest_wait) : seconds_to_pay;
    }

private:
    double wait_ = seconds_to_pay;
};

} // namespace pt
