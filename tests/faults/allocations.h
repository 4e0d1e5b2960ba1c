// Replaces the global operator new, so that a chosen allocation of the library fails.
#pragma once

#include <cstddef>

namespace faults {

// Counts this thread's allocations as the library's, in its scope.
class InLibrary {
public:
    InLibrary();
    ~InLibrary();
    InLibrary(const InLibrary &) = delete;
    InLibrary &operator=(const InLibrary &) = delete;
};

// Excludes them, in Vulkan and callbacks.
class OutOfLibrary {
public:
    OutOfLibrary();
    ~OutOfLibrary();
    OutOfLibrary(const OutOfLibrary &) = delete;
    OutOfLibrary &operator=(const OutOfLibrary &) = delete;

private:
    bool was_in_library_;
};

// number: counted from 1; 0: none. goes_on: all later ones fail too.
void fail_allocation(std::size_t number, bool goes_on);

// Whether it was reached, and whether it throws; callers of the others can do without.
bool allocation_failed();
bool allocation_threw();

long live_allocations();

// Starts measuring the library's peak memory; returns its current bytes.
long begin_most_bytes();
long most_live_bytes();

} // namespace faults
