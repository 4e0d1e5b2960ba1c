// The library's clock in fault tests advances on request only: no submission is overdue on a slow machine, slices are
// reproducible, and waiting for a hung device takes no time.
#pragma once

#include <chrono>

namespace faults {

void pass_time(std::chrono::nanoseconds duration);

} // namespace faults
