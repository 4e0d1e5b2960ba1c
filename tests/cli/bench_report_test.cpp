// Tests of cli/bench_report: what a row is made of, and which rows are told to be doubtful.
#include "cli/bench/bench_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <optional>

namespace {

cli::BenchRun run(double seconds, double mse, double sample_count = 16.0) {
    return {sample_count, seconds, 2.0 * seconds, {mse, 10.0 * mse}};
}

cli::BenchReport example_bench() {
    cli::BenchReport report{};
    report.render.width = 4;
    report.render.height = 2;
    std::strcpy(report.device.name, "a device");
    report.reference.sample_count = 1000;
    report.reference.noise = cli::ImageError{0.1, 1.0};
    report.cells = {
        {PT_SAMPLER_SOBOL, PT_ESTIMATOR_MIS, 16, 0.0, {run(1.0, 1.0), run(9.0, 3.0), run(2.0, 2.0)}},
        {PT_SAMPLER_SOBOL, PT_ESTIMATOR_MIS, 64, 0.0, {run(4.0, 0.125, 64.0)}},
        {PT_SAMPLER_RANDOM, PT_ESTIMATOR_MIS, 64, 0.0, {run(4.0, 0.0, 64.0)}},
        {PT_SAMPLER_RANDOM, PT_ESTIMATOR_MIS, 256, 0.0, {}}, // a signal came before it was done
    };
    return report;
}

TEST(BenchReport, Rows) {
    const auto rows = cli::bench_rows(example_bench());
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0].sampler, "sobol");
    EXPECT_EQ(rows[0].round_count, 3U);
    EXPECT_EQ(rows[0].seconds, 2.0); // the median
    EXPECT_EQ(rows[0].processor_seconds, 4.0);
    EXPECT_EQ(rows[0].error.mse, 2.0); // the mean
    EXPECT_DOUBLE_EQ(rows[0].efficiency.value(), 1.0 / (20.0 * 2.0));
    EXPECT_EQ(rows[0].slope, std::nullopt);
    EXPECT_DOUBLE_EQ(rows[1].slope.value(), -2.0); // 16 times less with 4 times as many samples
    EXPECT_EQ(rows[2].slope, std::nullopt);        // the row before is another sampler's
    EXPECT_EQ(rows[2].efficiency, std::nullopt);
}

TEST(BenchReport, ErrorsNearTheReferencesOwnAreMarked) {
    auto report = example_bench();
    EXPECT_FALSE(cli::bench_rows(report)[0].near_reference_noise); // 2 >= 3 * 0.1
    EXPECT_TRUE(cli::bench_rows(report)[1].near_reference_noise);  // 0.125 < 3 * 0.1
    EXPECT_NE(cli::bench_table(report).find("raise --reference-spp"), std::string::npos);
    report.reference = {"ref.exr", 0, 0, std::nullopt}; // whose noise is unknown
    EXPECT_FALSE(cli::bench_rows(report)[1].near_reference_noise);
    EXPECT_EQ(cli::bench_table(report).find("raise --reference-spp"), std::string::npos);
}

// Numbers of samples are means, and two targets may be reached with the same.
TEST(BenchReport, TargetErrors) {
    auto report = example_bench();
    report.cells = {{PT_SAMPLER_SOBOL, PT_ESTIMATOR_MIS, 65536, 0.05, {run(1.0, 1.0), run(2.0, 0.5, 20.5)}},
                    {PT_SAMPLER_SOBOL, PT_ESTIMATOR_MIS, 65536, 0.04, {run(1.0, 0.75, 18.25)}}};
    const auto rows = cli::bench_rows(report);
    EXPECT_EQ(rows[0].sample_count, 18.25); // the median
    EXPECT_EQ(rows[1].slope, std::nullopt);
    EXPECT_NE(cli::bench_csv(report).find("\nsobol,mis,0.04,18.25,1,"), std::string::npos);
    const auto json = cli::bench_json(report).at("cells");
    EXPECT_EQ(json.at(1).at("target_error"), 0.04);
    EXPECT_EQ(json.at(1).at("spp"), 18.25);
    EXPECT_TRUE(cli::bench_json(example_bench()).at("cells").at(0).at("target_error").is_null());
}

TEST(BenchReport, Forms) {
    const std::string csv = cli::bench_csv(example_bench());
    EXPECT_NE(csv.find("\nsobol,mis,,16,3,2,4,2,20,0.025,,0\n"), std::string::npos) << csv;
    const auto json = cli::bench_json(example_bench());
    EXPECT_EQ(json.at("cells").size(), 3U);
    EXPECT_TRUE(json.at("cells")[0].at("slope").is_null());
    EXPECT_EQ(json.at("reference").at("own_error").at("mse"), 0.1);
}

} // namespace
