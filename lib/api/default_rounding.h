// The rounding mode that the library computes in, whatever the caller's is.
#pragma once

#include <cfenv>

namespace pt {

// While it lives, this thread rounds to nearest. Threads started meanwhile inherit that: a driver's, which build
// kernels and run them.
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
