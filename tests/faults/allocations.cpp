#include "tests/faults/allocations.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <utility>

namespace {

thread_local bool in_library = false;
std::size_t allocation_count = 0; // count of one thread
std::size_t failing_number = 0;
bool failing_goes_on = false;
bool failed = false;
bool threw = false;
std::atomic<long> live{0}; // atomic: a driver's thread may free memory of the library
std::atomic<long> live_bytes{0};
long most_bytes = 0;

// Precedes the memory of each allocation, and keeps it aligned.
struct alignas(std::max_align_t) Header {
    std::size_t size;
    bool of_library;
};

bool is_to_fail() {
    if (!in_library)
        return false;
    ++allocation_count;
    const bool fails = failing_number != 0 &&
                       (failing_goes_on ? allocation_count >= failing_number : allocation_count == failing_number);
    failed = failed || fails;
    return fails;
}

void *allocate(std::size_t size) noexcept {
    if (is_to_fail())
        return nullptr;
    auto *header = static_cast<Header *>(std::malloc(sizeof(Header) + size));
    if (!header)
        return nullptr;
    header->size = size;
    header->of_library = in_library;
    if (in_library) {
        ++live;
        most_bytes = std::max(most_bytes, live_bytes += static_cast<long>(size));
    }
    return header + 1;
}

} // namespace

void *operator new(std::size_t size) {
    void *const memory = allocate(size);
    if (!memory) {
        threw = threw || in_library;
        throw std::bad_alloc();
    }
    return memory;
}
void *operator new(std::size_t size, const std::nothrow_t &) noexcept {
    return allocate(size);
}
void *operator new[](std::size_t size, const std::nothrow_t &) noexcept {
    return allocate(size);
}
void operator delete(void *memory) noexcept {
    if (!memory)
        return;
    Header *const header = static_cast<Header *>(memory) - 1;
    if (header->of_library) {
        --live;
        live_bytes -= static_cast<long>(header->size);
    }
    std::free(header);
}
void operator delete(void *memory, std::size_t) noexcept {
    operator delete(memory);
}

namespace faults {

InLibrary::InLibrary(bool is_in) : was_in_(std::exchange(in_library, is_in)) {}

InLibrary::~InLibrary() {
    in_library = was_in_;
}

void fail_allocation(std::size_t number, bool goes_on) {
    allocation_count = 0;
    failing_number = number;
    failing_goes_on = goes_on;
    failed = threw = false;
}

bool allocation_failed() {
    return failed;
}

bool allocation_threw() {
    return threw;
}

long live_allocations() {
    return live;
}

long begin_most_bytes() {
    most_bytes = live_bytes;
    return most_bytes;
}

long most_live_bytes() {
    return most_bytes;
}

} // namespace faults
