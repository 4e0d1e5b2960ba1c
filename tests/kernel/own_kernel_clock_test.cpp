#include "lib/code/own_kernel_clock.h"

#include <gtest/gtest.h>

namespace {

TEST(OwnKernelClockTest, WaitsTwiceAsLongAfterEachThatWasBuiltInVain) {
    pt::OwnKernelClock clock;
    for (double wait = 1.0; wait < 32.0; wait *= 2.0) {
        EXPECT_FALSE(clock.is_time(wait)) << wait;
        EXPECT_TRUE(clock.is_time(wait + 0.01)) << wait;
        clock.left_after(0.99);
    }
    clock.left_after(0.0);
    EXPECT_FALSE(clock.is_time(32.0));
    EXPECT_TRUE(clock.is_time(32.01)) << "but never longer";
    clock.left_after(1.0);
    EXPECT_TRUE(clock.is_time(1.01)) << "one has paid";
}

TEST(OwnKernelClockTest, WhatIsBuiltInVainIsAShareOfTheTime) {
    for (const double stop : {0.5, 1.1, 2.3, 5.0, 9.0, 31.0, 33.0}) {
        pt::OwnKernelClock clock;
        clock.left_after(0.0);
        int in_vain = 0;
        for (double time = 0.0; time < 1000.0; time += stop) {
            double wait = 0.0;
            while (wait < stop && !clock.is_time(wait))
                wait += 0.05;
            if (wait >= stop)
                continue;
            in_vain += stop - wait < pt::OwnKernelClock::seconds_to_pay ? 1 : 0;
            clock.left_after(stop - wait);
        }
        EXPECT_LE(in_vain, 5 + static_cast<int>(1000.0 / pt::OwnKernelClock::longest_wait)) << stop;
    }
}

} // namespace
