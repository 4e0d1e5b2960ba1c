// Replaces the global operator new, so that a chosen allocation fails.
#pragma once

#include <cstddef>

namespace faults {

class InLibrary {
public:
    InLibrary();
    ~InLibrary();
    InLibrary(const InLibrary &) = delete;
    InLibrary &operator=(const InLibrary &) = delete;
};

// Allocations by Vulkan or callbacks are not the library's. They do not fail while this object exists.
class OutOfLibrary {
public:
    OutOfLibrary();
    ~OutOfLibrary();
    OutOfLibrary(const OutOfLibrary &) = delete;
    OutOfLibrary &operator=(const OutOfLibrary &) = delete;

private:
    bool was_in_library_;
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
