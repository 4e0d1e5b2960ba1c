// The library's clock in the fault tests (linked with --wrap): each look at it is a millisecond later than the one
// before. So slices are cut in the same way each time, and a wait of seconds for a device that hangs takes none.
#include <chrono>

extern "C" std::chrono::steady_clock::time_point __wrap__ZNSt6chrono3_V212steady_clock3nowEv();

std::chrono::steady_clock::time_point __wrap__ZNSt6chrono3_V212steady_clock3nowEv() {
    static std::chrono::steady_clock::time_point time;
    return time += std::chrono::milliseconds{1};
}
