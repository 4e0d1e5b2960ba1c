// Tests of cli/sample_forecast.
#include "cli/render/sample_forecast.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace {

constexpr std::uint32_t most = 65536;

// pt.h names them: 16, 18, 20, ... 32, 36, 40, ... 64, 72.
TEST(SampleForecast, LooksWhenTheLibraryLooks) {
    std::vector<std::uint32_t> looks;
    for (std::uint32_t samples = 0; samples < 72;) {
        samples += cli::samples_to_next_look(samples);
        looks.push_back(samples);
    }
    EXPECT_EQ(looks,
              (std::vector<std::uint32_t>{16, 18, 20, 22, 24, 26, 28, 30, 32, 36, 40, 44, 48, 52, 56, 60, 64, 72}));
    EXPECT_EQ(cli::samples_to_next_look(3), 13U);
    EXPECT_EQ(cli::samples_to_next_look(17), 1U); // 18, as from 16
    EXPECT_EQ(cli::samples_to_next_look(0x80000000U), 0x10000000U);
}

TEST(SampleForecast, FallsWithTheRootOfTheNumber) {
    EXPECT_EQ(cli::forecast_sample_count(100, 0.03, 0.01, most), 900U);
    EXPECT_EQ(cli::forecast_sample_count(100, 1.0, 0.01, most), most);
    EXPECT_EQ(cli::forecast_sample_count(8, std::numeric_limits<double>::infinity(), 0.01, most), most);
}

TEST(SampleForecast, IsBeyondTheNextLookUnlessThatIsTheLast) {
    EXPECT_EQ(cli::forecast_sample_count(0, 0.01, 0.01, most), 17U);
    EXPECT_EQ(cli::forecast_sample_count(64, 0.01, 0.01, most), 73U);
    EXPECT_EQ(cli::forecast_sample_count(64, 0.01, 0.01, 70), 70U);
}

} // namespace
