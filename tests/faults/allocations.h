// Replaces the global operator new, so that a chosen allocation fails.
#pragma once

#include <cstddef>

namespace faults {

// Marks this thread's allocations as the library's. Allocations of Vulkan and of callbacks do not fail.
class InLibrary {
public:
    explicit InLibrary(bool is_in = true);
    ~InLibrary();
    InLibrary(const InLibrary &) = delete;
    InLibrary &operator=(const InLibrary &) = delete;

private:
    bool was_in_;
};

// `number` counts from 1, and 0 stops failures. With `goes_on`, all later allocations fail too.
void fail_allocation(std::size_t number, bool goes_on);

// Whether the chosen allocation was reached, and whether it throws. If it does not throw, the library may go on without
// the memory.
bool allocation_failed();
bool allocation_threw();

long live_allocations();

long begin_most_bytes();
long most_live_bytes();

} // namespace faults
