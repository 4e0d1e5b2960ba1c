// Decides when a scene has been rendered long enough for a kernel of its own to pay. Knows neither clock nor device:
// TracePipelines asks and reports.
#pragma once

#include <algorithm>

namespace pt {

// A kernel for one scene takes about 0.3 s to build and saves about a third of the time, so it pays after a second.
// Waiting just that long costs at most twice the optimum for a single scene (the ski rental problem). But a camera may
// stop again and again for a little longer. So the wait doubles whenever a kernel was left before it paid, and falls
// back when one has paid: kernels in vain then grow with the logarithm of the time, and at the limit take a hundredth
// of it.
class OwnKernelClock {
public:
    static constexpr double seconds_to_pay = 1.0;
    static constexpr double longest_wait = 32.0;

    // Whether a scene rendered for this long gets its own kernel.
    bool is_time(double seconds) const { return seconds > wait_; }

    // Reports that a scene's own kernel was used for this long until another scene came.
    void left_after(double seconds) {
        wait_ = seconds < seconds_to_pay ? std::min(2.0 * wait_, longest_wait) : seconds_to_pay;
    }

private:
    double wait_ = seconds_to_pay;
};

} // namespace pt
