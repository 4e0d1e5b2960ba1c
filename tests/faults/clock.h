// The library's clock in the fault tests, which stands still but for what the tests let take time: so no submission
// is overdue because the machine is slow, slices are cut in the same way each time, and a wait of seconds for a device
// that hangs takes none.
#pragma once

#include <chrono>

namespace faults {

void pass_time(std::chrono::nanoseconds duration);

} // namespace faults
