// A wild source also draws numbers that break rules.
#pragma once

#include "tests/fuzz/byte_reader.h"

#include <cstdint>

namespace fuzz {

class Numbers {
public:
    Numbers(ByteReader &bytes, bool wild) : bytes_(bytes), wild_(wild) {}

    double length();                        // 0 or in [1e-18, 1e18]
    double positive_length();               // in [1e-18, 1e18]
    double component();                     // finite
    double share();                         // in [0, 1]
    double field_of_view();                 // in [1e-8, pi)
    float color();                          // in [0, 1e18]
    float glossiness();                     // in [0, 1e9]
    std::uint32_t count(std::uint32_t end); // in [0, end), end <= 256

private:
    double ordinary();
    double any_magnitude(); // any sign, magnitude in [1e-18, 1e18]
    double boundary();
    bool breaks_rule() { return wild_ && bytes_.one_in(16); }
    double anything();

    ByteReader &bytes_;
    bool wild_;
};

} // namespace fuzz
