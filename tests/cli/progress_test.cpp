#include "cli/base/progress.h"

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

std::string output_of(ProgressStyle style, std::size_t columns = 80) {
    std::ostringstream output;
    {
        Progress progress(output, style, 1'000'000, 100, start, [columns] { return columns; });
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
    EXPECT_EQ(last.at("fraction"), 1.0);
    EXPECT_EQ(last.at("samples_per_pixel"), 100);
    EXPECT_EQ(last.at("samples_per_pixel_total"), 100);
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

TEST(Progress, TerminalLineFitsAnyWidth) {
    const auto line_of = [](std::size_t columns) {
        const std::string output = output_of(ProgressStyle::line, columns);
        const std::size_t begin = output.find(" 50.5 %");
        return begin == std::string::npos ? "" : output.substr(begin, output.find('\r', begin) - begin);
    };
    EXPECT_EQ(line_of(50), " 50.5 %  ETA 0:00:01  50/100 spp  50.0 Msamples/s");
    EXPECT_EQ(line_of(49), " 50.5 %  ETA 0:00:01  50/100 spp");
    EXPECT_EQ(line_of(21), " 50.5 %  ETA 0:00:01");
    EXPECT_EQ(line_of(20), " 50.5 %");
    EXPECT_EQ(line_of(8), " 50.5 %");
    EXPECT_EQ(line_of(7), "");
}

TEST(Progress, TheWidthIsAskedForEachTime) {
    std::ostringstream output;
    std::size_t columns = 80;
    Progress progress(output, ProgressStyle::line, 1'000'000, 100, start, [&columns] { return columns; });
    progress.update_samples(25.0, start + milliseconds(1000));
    columns = 10;
    progress.update_samples(50.0, start + milliseconds(2000));
    EXPECT_TRUE(output.str().ends_with("Msamples/s\r\x1b[K 50.0 %")) << output.str();
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

TEST(Progress, NoneIsSilent) {
    EXPECT_EQ(output_of(ProgressStyle::none), "");
}

TEST(Progress, StyleFollowsTheTerminal) {
    EXPECT_EQ(cli::progress_style("auto", false, true), ProgressStyle::line);
    EXPECT_EQ(cli::progress_style("auto", false, false), ProgressStyle::none);
    EXPECT_EQ(cli::progress_style("json", false, true), ProgressStyle::json);
    EXPECT_EQ(cli::progress_style("none", false, true), ProgressStyle::none);
    EXPECT_EQ(cli::progress_style("json", true, true), ProgressStyle::none); // -q
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
    EXPECT_EQ(output_after(ProgressStyle::json, 1000), "");
    EXPECT_EQ(output_after(ProgressStyle::none, 1000), "");
}

std::string line_after(Progress::Clock::duration time, double samples, const std::function<void(Progress &)> &prepare) {
    std::ostringstream output;
    Progress progress(output, ProgressStyle::line, 1'000'000, 100, start, [] { return std::size_t{80}; });
    prepare(progress);
    progress.update_samples(samples, start + time);
    return output.str().substr(std::string("\r\x1b[K").size());
}

TEST(Progress, TheErrorIsShownOnceItIsKnown) {
    EXPECT_EQ(line_after(milliseconds(1000), 50.0, [](Progress &progress) { progress.show_error(0.012345); }),
              " 50.0 %  ETA 0:00:01  50/100 spp  error 1.23%  50.0 Msamples/s");
    constexpr double unknown = std::numeric_limits<double>::infinity();
    EXPECT_EQ(line_after(milliseconds(1000), 50.0, [](Progress &progress) { progress.show_error(unknown); }),
              " 50.0 %  ETA 0:00:01  50/100 spp  50.0 Msamples/s");
}

TEST(Progress, SamplesOfAnotherRunTookNoTime) {
    EXPECT_EQ(line_after(milliseconds(1000), 60.0, [](Progress &progress) { progress.begin_at(40); }),
              " 60.0 %  ETA 0:00:02  60/100 spp  20.0 Msamples/s");
}

TEST(Progress, TimeCountsWhereItEndsSooner) {
    EXPECT_EQ(line_after(milliseconds(3000), 10.0, [](Progress &progress) { progress.limit_time(4.0); }),
              " 75.0 %  ETA 0:00:01  10/100 spp  3.3 Msamples/s");
    EXPECT_EQ(line_after(milliseconds(3000), 90.0, [](Progress &progress) { progress.limit_time(4000.0); }),
              " 90.0 %  ETA 0:00:01  90/100 spp  30.0 Msamples/s");
}

} // namespace
