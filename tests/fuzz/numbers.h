// Numbers for scenes, drawn from the fuzzer's bytes: ordinary ones, ones of any magnitude, and those at the ends of the
// ranges in pt.h. A wild source also gives numbers that break the rules.
#pragma once

#include "tests/fuzz/byte_reader.h"

#include <cstdint>

namespace fuzz {

class Numbers {
public:
    Numbers(ByteReader &bytes, bool wild) : bytes_(bytes), wild_(wild) {}

    double length();                        // 0 or of a magnitude in [1e-18, 1e18]
    double positive_length();               // in [1e-18, 1e18]
    double component();                     // of a vector that may be longer or shorter than any length: finite
    double share();                         // in [0, 1]
    double field_of_view();                 // in [1e-8, pi)
    float color();                          // in [0, 1e18]
    float glossiness();                     // in [0, 1e9]
    std::uint32_t count(std::uint32_t end); // in [0, end), end <= 256

private:
    double ordinary();
    double any_magnitude(); // in [1e-18, 1e18] or the negative of it
    double boundary();      // a length that is an end of a range, of the rules or of float32
    bool breaks_rule() { return wild_ && bytes_.one_in(16); }
    double anything();

    ByteReader &bytes_;
    bool wild_;
};

} // namespace fuzz
