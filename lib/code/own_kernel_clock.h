#pragma once

#include <algorithm>

namespace pt {

// Decides when a scene gets its own kernel. After a second of use the kernel has saved the time of its build. Waiting a
// second before the build takes at most twice the optimal time (ski rental problem). The wait doubles if a kernel was
// used for less than a second, and is reset otherwise.
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
