// Fails every allocation once.
#include "tests/faults/allocations.h"
#include "tests/faults/sweep.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

namespace {

using namespace faults;

class FailingAllocation : public Injection {
public:
    FailingAllocation(std::size_t number, bool goes_on, std::size_t &failures) :
        number_(number),
        goes_on_(goes_on),
        failures_(failures) {}

    void arm() override { fail_allocation(number_, goes_on_); }

    bool disarm(const std::string &step, pt_result result, const std::string &message) override {
        const bool failed = allocation_failed();
        const bool threw = allocation_threw();
        fail_allocation(0, false);
        if (!failed)
            return false;
        ++failures_;
        // A call may succeed without memory from an allocation that does not throw.
        if (threw && step != "pt_destroy") {
            EXPECT_EQ(pt_result_name(result), std::string("PT_ERROR_OUT_OF_HOST_MEMORY"))
                << step << ", allocation " << number_ << ": " << message;
            EXPECT_NE(message, "");
        }
        return true;
    }

private:
    std::size_t number_;
    bool goes_on_;
    std::size_t &failures_;
};

void fail_every_allocation(const Setting &setting, bool goes_on) {
    std::size_t failures = 0;
    sweep(setting, undisturbed_images(), Life::all_steps(),
          [&](std::size_t number) { return std::make_unique<FailingAllocation>(number, goes_on, failures); });
    EXPECT_GT(failures, 1000U);
}

TEST(HostMemoryTest, EveryAllocationMayFail) {
    fail_every_allocation({.gpu = false, .device_count = 1, .submit_milliseconds = 2}, false);
}

TEST(HostMemoryTest, EveryAllocationMayBeTheLast) {
    fail_every_allocation({.gpu = true, .device_count = 2, .submit_milliseconds = 1}, true);
}

} // namespace
