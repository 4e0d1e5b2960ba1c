#include "tests/faults/sweep.h"

#include "tests/faults/allocations.h"
#include "tests/faults/vulkan_calls.h"
#include "tests/support/sized.h"

#include <gtest/gtest.h>

namespace faults {

namespace {

// A long error message enlarges the thread's message buffer once, so that later messages do not allocate.
void keep_a_long_message() {
    const std::string no_device(1000, '?');
    auto create = sized<pt_create_info>();
    create.device = no_device.c_str();
    pt_context *context = nullptr;
    EXPECT_EQ(pt_create(&create, &context), PT_ERROR_NO_DEVICE);
}

void expect_nothing_left(std::size_t number, long allocations_before) {
    for (const auto &[maker, count] : live_objects())
        ADD_FAILURE() << "place " << number << ": " << count << " objects of " << maker << " are left";
    EXPECT_EQ(live_allocations(), allocations_before) << "place " << number;
    forget_objects();
}

} // namespace

void sweep(const Setting &setting, const ExpectedImages &expected, const Steps &steps,
           const InjectionAt &injection_at) {
    keep_a_long_message();
    Steps wanted = steps;
    for (std::size_t number = 1; !wanted.empty() && !testing::Test::HasFatalFailure(); ++number) {
        const std::unique_ptr<Injection> injection = injection_at(number);
        Steps met;
        Steps left = wanted;
        while (!left.empty()) {
            const long allocations_before = live_allocations();
            Life life(setting, expected, left);
            life.live(*injection);
            heal_devices();
            expect_nothing_left(number, allocations_before);
            met.insert(life.met().begin(), life.met().end());
            for (const std::string &step : life.attempted())
                left.erase(step);
        }
        wanted = met;
    }
}

} // namespace faults
