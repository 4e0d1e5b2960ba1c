// Replaces the library's clock, which then advances only on request. Slices become reproducible, and hung devices take
// no time.
#pragma once

#include <chrono>

namespace faults {

void pass_time(std::chrono::nanoseconds duration);

} // namespace faults
