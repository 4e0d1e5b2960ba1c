// Replaces the library's clock (linker option --wrap). The clock advances only on request, so slices are reproducible
// and hung devices take no time.
#pragma once

#include <chrono>

namespace faults {

void pass_time(std::chrono::nanoseconds duration);

} // namespace faults
