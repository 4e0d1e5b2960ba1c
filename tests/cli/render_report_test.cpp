#include "cli/base/devices.h"
#include "cli/picture/render_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <limits>

namespace {

cli::RenderReport example_render() {
    cli::RenderReport report{};
    report.render.width = 256;
    report.render.height = 128;
    report.window = cli::whole_window(256, 128);
    report.stats.sample_count = report.stats.max_sample_count = 32;
    report.stats.mean_sample_count = 32.0;
    report.accumulate_seconds = 2.0;
    report.total_seconds = 2.5;
    std::strcpy(report.device.name, "a device");
    return report;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

void set_error(cli::RenderReport &report, double estimate, double low, double high) {
    report.error.relative_rmse = estimate;
    report.error.relative_rmse_low = low;
    report.error.relative_rmse_high = high;
}

TEST(RenderReport, PixelsWithDifferentNumbersOfSamples) {
    cli::RenderReport report = example_render();
    report.stats.sample_count = 16;
    report.stats.mean_sample_count = 37.3125;
    report.stats.max_sample_count = 64;
    const auto json = cli::stats_json(report);
    EXPECT_EQ(json.at("spp"), 16);
    EXPECT_EQ(json.at("spp_mean"), 37.3125);
    EXPECT_EQ(json.at("spp_max"), 64);
    EXPECT_EQ(json.at("samples_per_second"), 256.0 * 128.0 * 37.3125 / 2.0);
    EXPECT_EQ(cli::summary_text(report), "256x128, 37.3 (16 to 64) spp in 2.50 s on a device");
    set_error(report, 0.0042, 0.0040, 0.0044);
    report.target_error = 0.0044;
    report.target_reached = true;
    EXPECT_TRUE(cli::error_text(report).ends_with("target reached after 37.3 (16 to 64) samples"));
    report.target_error = 0.0043;
    report.target_reached = false;
    EXPECT_TRUE(cli::error_text(report).ends_with("after 37.3 (16 to 64) samples, raise --spp"));
    report.window.part = {10, 20, 40, 30};
    EXPECT_EQ(cli::stats_json(report).at("samples_per_second"), 256.0 * 30.0 * 37.3125 / 2.0);
}

TEST(RenderReport, AnUncertainErrorIsCalledSo) {
    cli::RenderReport report = example_render();
    set_error(report, 0.0042, 0.0040, 0.0044);
    EXPECT_EQ(cli::stats_json(report).at("uncertain"), nlohmann::json::array());
    const auto text_with = [&](std::uint32_t uncertain) {
        report.error.uncertain = uncertain;
        return cli::error_text(report);
    };
    EXPECT_EQ(text_with(PT_UNCERTAIN_RMSE), "error 0.42% (0.4% to 0.44%)");
    EXPECT_EQ(text_with(PT_UNCERTAIN_RELATIVE_RMSE),
              "error 0.42% (0.4% to 0.44%), uncertain: a few bright pixels cause most of it, take more samples");
    EXPECT_EQ(text_with(PT_UNCERTAIN_UNSEEN),
              "error 0.42% (0.4% to 0.44%), uncertain: dark pixels beside bright ones may have light that no sample "
              "has hit, take more samples");
    EXPECT_EQ(text_with(15), "error 0.42% (0.4% to 0.44%), uncertain: few samples hit small lamps, take more");
    set_error(report, infinity, 0.0, infinity);
    EXPECT_EQ(cli::error_text(report), "error unknown, uncertain: few samples hit small lamps, take more");
    EXPECT_EQ(cli::stats_json(report).at("uncertain"),
              (std::vector<std::string>{"rmse", "relative_rmse", "unseen", "unmet"}));
}

TEST(RenderReport, BytesAreToldInTheirUnit) {
    EXPECT_EQ(cli::memory_text(1023), "1023 B");
    EXPECT_EQ(cli::memory_text((1 << 20) - 1), "1.0 MiB");
    EXPECT_EQ(cli::memory_text((1 << 20) - 60), "1023.9 KiB");
    EXPECT_EQ(cli::memory_text(std::uint64_t{5} << 40), "5.0 TiB");
    EXPECT_EQ(cli::memory_text(std::numeric_limits<std::uint64_t>::max()), "16.0 EiB");
}

} // namespace
