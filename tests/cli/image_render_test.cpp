#include "cli/render/image_render.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace {

constexpr std::uint32_t most = 65536;

TEST(SampleForecast, FallsWithTheRootOfTheNumber) {
    EXPECT_EQ(cli::forecast_sample_count(100, 0.03, 0.01, most), 900U);
    EXPECT_EQ(cli::forecast_sample_count(100, 1.0, 0.01, most), most);
    EXPECT_EQ(cli::forecast_sample_count(8, std::numeric_limits<double>::infinity(), 0.01, most), most);
}

TEST(SampleForecast, IsBeyondTheNextLookUnlessThatIsTheLast) {
    EXPECT_EQ(cli::forecast_sample_count(0, 0.01, 0.01, most), 17U);
    EXPECT_EQ(cli::forecast_sample_count(64, 0.01, 0.01, most), 81U);
    EXPECT_EQ(cli::forecast_sample_count(64, 0.01, 0.01, 70), 70U);
}

TEST(StepLength, AimsAtItsTimeAndHasALeast) {
    EXPECT_EQ(cli::next_step_length(16, 2.0 * cli::step_seconds), 16U);
    EXPECT_EQ(cli::next_step_length(100, 4.0 * cli::step_seconds), 25U);
    EXPECT_EQ(cli::next_step_length(100, 0.5 * cli::step_seconds), 200U);
    EXPECT_EQ(cli::next_step_length(1, 0.5 * cli::step_seconds), 16U);
    EXPECT_EQ(cli::next_step_length(100, 0.0), 1U << 30);
    EXPECT_EQ(cli::next_step_length(4000000000U, 1e-9), 1U << 30);
}

} // namespace
