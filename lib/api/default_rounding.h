// Sets the rounding mode that the library computes in, whatever the caller's is.
#pragma once

#include <cfenv>

namespace pt {

// While it lives, this thread rounds to nearest. Threads that are started meanwhile inherit that, such as those with
// which a driver builds and runs kernels.
class DefaultRounding {
public:
    DefaultRounding() noexcept : callers_(std::fegetround()) { set(FE_TONEAREST); }
    ~DefaultRounding() { set(callers_); }
    DefaultRounding(const DefaultRounding &) = delete;
    DefaultRounding &operator=(const DefaultRounding &) = delete;

private:
    // Reading the mode is cheap, setting it is not.
    void set(int mode) const noexcept {
        if (callers_ != FE_TONEAREST)
            std::fesetround(mode);
    }

    int callers_;
};

} // namespace pt
