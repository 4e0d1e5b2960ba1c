#include "cli/base/progress.h"
#include "cli/render/image_render.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <sstream>

namespace {

using cli::Progress;
using cli::ProgressStyle;
using std::chrono::milliseconds;

const Progress::Clock::time_point start{};

std::string output_of(ProgressStyle style) {
    std::ostringstream output;
    {
        Progress progress(output, style, 1'000'000, 100, start, [] { return std::size_t{80}; });
        for (int i = 1; i <= 200; ++i)
            progress.update_samples(i / 2.0, start + milliseconds(10 * i));
    }
    return output.str();
}

TEST(Progress, JsonLines) {
    std::istringstream lines(output_of(ProgressStyle::json));
    int count = 0;
    nlohmann::json last;
    for (std::string line; std::getline(lines, line); ++count)
        last = nlohmann::json::parse(line);
    EXPECT_GE(count, 19);
    EXPECT_LE(count, 21);
    EXPECT_EQ(last.at("eta_seconds"), 0.0);
    EXPECT_NEAR(last.at("samples_per_second").get<double>(), 50e6, 1.0);
}

TEST(Progress, TerminalLine) {
    const std::string output = output_of(ProgressStyle::line);
    EXPECT_LE(std::count(output.begin(), output.end(), '\r'), 22);
    EXPECT_EQ(output.find('\n'), std::string::npos);
    EXPECT_NE(output.find(" 50.5 %  ETA 0:00:01  50/100 spp  50.0 Msamples/s\r"), std::string::npos) << output;
    EXPECT_TRUE(output.ends_with("\r\x1b[K"));
}

std::string line_after(int time, double samples, const std::function<void(Progress &)> &prepare,
                       std::size_t columns = 80) {
    std::ostringstream output;
    std::size_t columns_now = 80;
    Progress progress(output, ProgressStyle::line, 1'000'000, 100, start, [&] { return columns_now; });
    columns_now = columns;
    prepare(progress);
    progress.update_samples(samples, start + milliseconds(time));
    return output.str().substr(std::string("\r\x1b[K").size());
}

TEST(Progress, TerminalLineFitsAnyWidth) {
    const auto line_of = [](std::size_t columns) {
        return line_after(
            1010, 50.5, [](Progress &) {}, columns);
    };
    EXPECT_EQ(line_of(50), " 50.5 %  ETA 0:00:01  50/100 spp  50.0 Msamples/s");
    EXPECT_EQ(line_of(49), " 50.5 %  ETA 0:00:01  50/100 spp");
    EXPECT_EQ(line_of(21), " 50.5 %  ETA 0:00:01");
    EXPECT_EQ(line_of(20), " 50.5 %");
    EXPECT_EQ(line_of(8), " 50.5 %");
    EXPECT_EQ(line_of(7), "");
}

TEST(Progress, NeverFallsWhateverIsExpected) {
    std::ostringstream output;
    Progress progress(output, ProgressStyle::json, 1, 100, start);
    progress.update_samples(50.0, start + milliseconds(1000));
    progress.expect(1000);
    progress.update_samples(60.0, start + milliseconds(2000));
    progress.expect(80);
    progress.update_samples(80.0, start + milliseconds(2001));
    std::istringstream lines(output.str());
    for (const auto &[fraction, samples, total] :
         {std::array{0.5, 50.0, 100.0}, {0.5, 60.0, 1000.0}, {1.0, 80.0, 80.0}}) {
        std::string line;
        ASSERT_TRUE(std::getline(lines, line));
        const auto json = nlohmann::json::parse(line);
        EXPECT_EQ(json.at("fraction"), fraction);
        EXPECT_EQ(json.at("samples_per_pixel"), samples);
        EXPECT_EQ(json.at("samples_per_pixel_total"), total);
    }
}

TEST(Progress, OfTheSceneIsALineThatGoesAway) {
    const auto output_after = [](ProgressStyle style, int milliseconds_in_all) {
        std::ostringstream output;
        {
            Progress progress(output, style, 0, 0, start);
            for (int i = 0; i <= milliseconds_in_all; ++i)
                progress.update_scene(i / 1000.0, start + milliseconds(i));
        }
        return output.str();
    };
    EXPECT_EQ(output_after(ProgressStyle::line, 99), "");
    EXPECT_EQ(output_after(ProgressStyle::line, 250), "\r\x1b[Kscene  10 %\r\x1b[Kscene  20 %\r\x1b[K");
    for (const ProgressStyle style : {ProgressStyle::json, ProgressStyle::none})
        EXPECT_EQ(output_after(style, 1000), "");
}

TEST(Progress, LinesFollowErrorStartAndTimeLimit) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    EXPECT_EQ(line_after(1000, 50.0, [](Progress &progress) { progress.show_error(0.012345); }),
              " 50.0 %  ETA 0:00:01  50/100 spp  error 1.23%  50.0 Msamples/s");
    EXPECT_EQ(line_after(1000, 50.0, [](Progress &progress) { progress.show_error(unknown); }),
              " 50.0 %  ETA 0:00:01  50/100 spp  50.0 Msamples/s");
    EXPECT_EQ(line_after(1000, 60.0, [](Progress &progress) { progress.begin_at(40); }),
              " 60.0 %  ETA 0:00:02  60/100 spp  20.0 Msamples/s");
    EXPECT_EQ(line_after(3000, 10.0, [](Progress &progress) { progress.limit_time(4.0); }),
              " 75.0 %  ETA 0:00:01  10/100 spp  3.3 Msamples/s");
    EXPECT_EQ(line_after(3000, 90.0, [](Progress &progress) { progress.limit_time(4000.0); }),
              " 90.0 %  ETA 0:00:01  90/100 spp  30.0 Msamples/s");
}

TEST(SampleForecast, FallsWithTheRootOfTheNumberAndIsBeyondTheNextLook) {
    constexpr std::uint32_t most = 65536;
    EXPECT_EQ(cli::forecast_sample_count(100, 0.03, 0.01, most), 900U);
    EXPECT_EQ(cli::forecast_sample_count(100, 1.0, 0.01, most), most);
    EXPECT_EQ(cli::forecast_sample_count(8, std::numeric_limits<double>::infinity(), 0.01, most), most);
    EXPECT_EQ(cli::forecast_sample_count(0, 0.01, 0.01, most), 17U);
    EXPECT_EQ(cli::forecast_sample_count(64, 0.01, 0.01, 70), 70U);
}

TEST(StepLength, AimsAtItsTimeAndHasALeast) {
    EXPECT_EQ(cli::next_step_length(100, 4.0 * cli::step_seconds), 25U);
    EXPECT_EQ(cli::next_step_length(100, 0.5 * cli::step_seconds), 200U);
    EXPECT_EQ(cli::next_step_length(1, 0.5 * cli::step_seconds), 16U);
    EXPECT_EQ(cli::next_step_length(100, 0.0), 1U << 30);
    EXPECT_EQ(cli::next_step_length(4000000000U, 1e-9), 1U << 30);
}

} // namespace
