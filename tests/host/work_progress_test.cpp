// What is told of a long call: shares that never fall, stage by stage, and an end where it is asked for.
#include "lib/base/work_progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace work_progress {

namespace {

struct Listener {
    std::vector<double> shares;
    std::size_t most = SIZE_MAX; // calls that go on

    static std::int32_t receive(void *user, double share) {
        auto *const listener = static_cast<Listener *>(user);
        listener->shares.push_back(share);
        return listener->shares.size() > listener->most ? -1 : 0;
    }
};

constexpr std::size_t many = std::size_t{1} << 20; // elements, after which something is told

TEST(WorkProgress, TellsSharesOfStages) {
    Listener listener;
    pt::WorkProgress progress(&Listener::receive, &listener);
    progress.enter(0.25, 4.0);
    progress.add(1.0, many);
    progress.add(2.0, 0); // with the next
    progress.add(1.0, many);
    progress.enter(0.5, 8.0); // 3/8 of the whole
    progress.add(2.0, many);
    progress.enter(0.5, 0.0); // 3/16, in which nothing is done
    progress.add(0.0, many);
    progress.enter(1.0, 1.0); // 3/16
    progress.add(7.0, many);  // more than there was
    EXPECT_EQ(listener.shares, (std::vector<double>{0.0625, 0.25, 0.34375, 0.625, 1.0}));
    progress.finish();
    EXPECT_EQ(listener.shares.back(), 1.0);
    EXPECT_EQ(listener.shares.size(), 6U);
}

TEST(WorkProgress, FinishesFromAnywhere) {
    Listener listener;
    pt::WorkProgress progress(&Listener::receive, &listener);
    progress.enter(0.5, 100.0);
    progress.add(3);
    progress.finish();
    EXPECT_EQ(listener.shares, (std::vector<double>{1.0}));
}

// Seldom enough for a function that takes a microsecond, as in Python, and often enough for who waits.
TEST(WorkProgress, TellsAfterAHundredThousandElements) {
    Listener listener;
    pt::WorkProgress progress(&Listener::receive, &listener);
    progress.enter(1.0, 1e6);
    for (int i = 0; i < 1'000'000; ++i)
        progress.add(1);
    EXPECT_GE(listener.shares.size(), 5U);
    EXPECT_LE(listener.shares.size(), 20U);
    EXPECT_TRUE(std::ranges::is_sorted(listener.shares));
}

TEST(WorkProgress, EndsWhereAnythingButNullIsReturned) {
    Listener listener{.shares = {}, .most = 2};
    pt::WorkProgress progress(&Listener::receive, &listener);
    progress.enter(1.0, 8.0);
    progress.add(1.0, many);
    progress.add(1.0, many);
    EXPECT_THROW(progress.add(1.0, many), pt::Cancelled);
    EXPECT_EQ(listener.shares.size(), 3U);
    EXPECT_THROW(progress.finish(), pt::Cancelled);
}

TEST(WorkProgress, MayTellNobody) {
    pt::WorkProgress progress;
    progress.enter(0.5, 1.0);
    progress.add(many);
    EXPECT_NO_THROW(progress.finish());
}

} // namespace

} // namespace work_progress
