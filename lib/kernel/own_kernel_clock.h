// Decides when a scene has been rendered long enough for a specialized kernel to pay.
#pragma once

#include <algorithm>

namespace pt {

// A kernel for one scene pays after a second. Waiting that long costs at most twice the optimum (the ski rental
// problem). The wait doubles whenever a kernel was left before it paid, and falls back when one has paid. The number of
// useless kernels then grows with the logarithm of time.
class OwnKernelClock {
public:
    static constexpr double seconds_to_pay = 1.0;
    static constexpr double longest_wait = 32.0;

    // seconds: spent on the scene so far.
    bool is_time(double seconds) const { return seconds > wait_; }

    // seconds: spent with the last specialized kernel.
    void left_after(double seconds) {
        wait_ = seconds < seconds_to_pay ? std::min(2.0 * wait_, longest_wait) : seconds_to_pay;
    }

private:
    double wait_ = seconds_to_pay;
};

} // namespace pt
