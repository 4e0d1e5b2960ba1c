// The library's clock, which advances on request only: slices are reproducible, and hung devices take no time.
#pragma once

#include <chrono>

namespace faults {

void pass_time(std::chrono::nanoseconds duration);

} // namespace faults
