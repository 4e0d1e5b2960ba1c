// Host memory that runs out on demand: replaces the global operator new, so that a chosen allocation of the library
// fails.
#pragma once

#include <cstddef>

namespace faults {

// While it lives, allocations of this thread are the library's.
class InLibrary {
public:
    InLibrary();
    ~InLibrary();
    InLibrary(const InLibrary &) = delete;
    InLibrary &operator=(const InLibrary &) = delete;
};

// While it lives, they are not: the library is in Vulkan, or in a callback.
class OutOfLibrary {
public:
    OutOfLibrary();
    ~OutOfLibrary();
    OutOfLibrary(const OutOfLibrary &) = delete;
    OutOfLibrary &operator=(const OutOfLibrary &) = delete;

private:
    bool was_in_library_;
};

// The library's allocation with a number, counted from 1, fails; with goes_on all after it, too. 0: none fails.
void fail_allocation(std::size_t number, bool goes_on);

// Whether it was reached, and whether by an allocation that throws: the others are made by those who can do without.
bool allocation_failed();
bool allocation_threw();

// Allocations of the library that are not freed.
long live_allocations();

// The bytes of what the library has made and not freed, from where on the most is noted that there are; and that.
long begin_most_bytes();
long most_live_bytes();

} // namespace faults
