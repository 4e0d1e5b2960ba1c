#include "tests/faults/clock.h"

extern "C" std::chrono::steady_clock::time_point __wrap__ZNSt6chrono3_V212steady_clock3nowEv();

namespace {

std::chrono::steady_clock::time_point present;

} // namespace

namespace faults {

void pass_time(std::chrono::nanoseconds duration) {
    present += duration;
}

} // namespace faults

std::chrono::steady_clock::time_point __wrap__ZNSt6chrono3_V212steady_clock3nowEv() {
    return present;
}
