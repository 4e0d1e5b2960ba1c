#pragma once

#include <algorithm>

namespace pt {

// The kernel pays after a second of use. Waiting that long costs at most twice the optimum (ski rental problem). The
// wait doubles after a kernel that did not pay, and is reset after one that did.
class OwnKernelClock {
public:
    static constexpr double seconds_to_pay = 1.0;
    static constexpr double longest_wait = 32.0;

    bool is_time(double seconds) const { return seconds > wait_; }

    void left_after(double seconds) {
        wait_ = seconds < seconds_to_pay ? std::min(2.0 * wait_, longest_wait) : seconds_to_pay;
    }

private:
    double wait_ = seconds_to_pay;
};

} // namespace pt
