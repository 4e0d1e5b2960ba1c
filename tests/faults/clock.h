// The library's clock in the fault tests. It advances only when the tests say so: no submission is overdue because the
// machine is slow, slices are always cut in the same way, and waiting seconds for a device that hangs takes no time.
#pragma once

#include <chrono>

namespace faults {

void pass_time(std::chrono::nanoseconds duration);

} // namespace faults
