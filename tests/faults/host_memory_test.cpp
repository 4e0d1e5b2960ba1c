// Fails every allocation once.
#include "tests/faults/allocations.h"
#include "tests/faults/life.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

namespace {

using namespace faults;

void fail_every_allocation(const Setting &setting, bool goes_on) {
    std::size_t failures = 0;
    const auto arm = [&](const std::string &step, std::size_t number) {
        fail_allocation(call_number(step, number), goes_on);
    };
    const auto disarm = [&](const std::string &step, pt_result result, const std::string &message) {
        const bool failed = allocation_failed();
        const bool threw = allocation_threw();
        fail_allocation(0, false);
        failures += failed ? 1 : 0;
        // A call may succeed without memory from an allocation that does not throw.
        if (threw && step != "pt_destroy") {
            EXPECT_EQ(pt_result_name(result), std::string("PT_ERROR_OUT_OF_HOST_MEMORY")) << step << ": " << message;
            EXPECT_NE(message, "");
        }
        return failed;
    };
    sweep(setting, undisturbed(), {arm, disarm});
    EXPECT_GT(failures, 1000U);
}

TEST(HostMemoryTest, EveryAllocationMayFail) {
    fail_every_allocation({.gpu = false, .device_count = 1, .submit_milliseconds = 2}, false);
}

TEST(HostMemoryTest, EveryAllocationMayBeTheLast) {
    fail_every_allocation({.gpu = true, .device_count = 2, .submit_milliseconds = 1}, true);
}

} // namespace
