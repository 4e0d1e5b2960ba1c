// Replaces the global operator new, to fail a chosen allocation.
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

// Excludes Vulkan and callbacks.
class OutOfLibrary {
public:
    OutOfLibrary();
    ~OutOfLibrary();
    OutOfLibrary(const OutOfLibrary &) = delete;
    OutOfLibrary &operator=(const OutOfLibrary &) = delete;

private:
    bool was_in_library_;
};

// number: from 1; 0: none. goes_on: all later ones fail too.
void fail_allocation(std::size_t number, bool goes_on);

// Whether it was reached, and whether it throws; others are optional.
bool allocation_failed();
bool allocation_threw();

long live_allocations();

long begin_most_bytes();
long most_live_bytes();

} // namespace faults
