// Tests of cli/render/render_report.
#include "cli/base/devices.h"
#include "cli/render/render_report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <limits>
#include <map>

namespace {

// Of all pixels.
void set_sample_count(pt_stats &stats, std::uint32_t count) {
    stats.sample_count = stats.max_sample_count = count;
    stats.mean_sample_count = count;
}

cli::RenderReport example_render() {
    cli::RenderReport report{};
    report.scene = "scene.json";
    report.render.width = 256;
    report.render.height = 128;
    report.window = cli::whole_window(256, 128);
    report.render.seed = 18446744073709551615U;
    report.render.first_sample = 4294967295U;
    report.render.max_path_length = 6;
    report.render.sampler = PT_SAMPLER_HALTON_CP;
    report.render.estimator = PT_ESTIMATOR_MIS;
    report.requested_sample_count = 64;
    set_sample_count(report.stats, 32);
    report.stats.rejected_samples = 3;
    report.stats.features = PT_FEATURE_LAMPS | PT_FEATURE_LARGE;
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

TEST(RenderReport, StatsJson) {
    const auto json = cli::stats_json(example_render());
    EXPECT_EQ(json.at("scene"), "scene.json");
    for (const char *samples : {"spp", "spp_mean", "spp_max"}) {
        EXPECT_EQ(json.at(samples), 32) << samples;
    }
    EXPECT_EQ(json.at("spp_requested"), 64);
    EXPECT_EQ(json.at("seed"), 18446744073709551615U);
    EXPECT_EQ(json.at("first_sample"), 4294967295U);
    EXPECT_EQ(json.at("sampler"), "halton-cp");
    EXPECT_EQ(json.at("estimator"), "mis");
    EXPECT_EQ(json.at("device").at("name"), "a device");
    EXPECT_EQ(json.at("features"), (std::vector<std::string>{"lamps", "large"}));
    EXPECT_EQ(json.at("samples_per_second"), 256.0 * 128.0 * 32.0 / 2.0);
    EXPECT_GT(json.at("peak_host_bytes"), 1'000'000); // no C++ program is smaller
}

TEST(RenderReport, ToneMapAndWarningsInJson) {
    cli::RenderReport report = example_render();
    EXPECT_TRUE(cli::stats_json(report).at("tone_map").is_null()); // EXR alone
    EXPECT_EQ(cli::stats_json(report).at("warnings"), nlohmann::json::array());
    report.tone_map = cli::ToneMap{-3.13, cli::ToneCurve::agx, std::nullopt};
    report.tone_map->is_automatic = true;
    report.warnings = {"one", "two"};
    const auto json = cli::stats_json(report);
    EXPECT_EQ(json.at("tone_map").dump(), R"({"curve":"agx","exposure":-3.13,"automatic_exposure":true,"gamma":null})");
    EXPECT_EQ(json.at("warnings"), (std::vector<std::string>{"one", "two"}));
    EXPECT_EQ(cli::automatic_exposure_line(report.tone_map), "exposure -3.13 EV (auto)\n");
    report.tone_map->gamma = 2.2;
    EXPECT_EQ(cli::stats_json(report).at("tone_map").at("gamma"), 2.2);
}

TEST(RenderReport, ErrorInJson) {
    cli::RenderReport report = example_render();
    report.error.rmse = report.error.rmse_high = report.error.relative_rmse = report.error.relative_rmse_high =
        infinity;
    auto json = cli::stats_json(report);
    for (const char *key : {"rmse", "rmse_high", "relative_rmse", "relative_rmse_high", "target_error"}) {
        EXPECT_TRUE(json.at(key).is_null()) << key;
    }
    EXPECT_EQ(json.at("rmse_low"), 0.0);
    EXPECT_EQ(json.at("target_reached"), false);

    set_error(report, 0.0042, 0.0040, 0.0044);
    report.error.rmse = 7.0;
    report.target_error = 0.0044;
    json = cli::stats_json(report);
    EXPECT_EQ(json.at("rmse"), 7.0);
    EXPECT_EQ(json.at("relative_rmse"), 0.0042);
    EXPECT_EQ(json.at("relative_rmse_low"), 0.0040);
    EXPECT_EQ(json.at("relative_rmse_high"), 0.0044);
    EXPECT_EQ(json.at("target_error"), 0.0044);
    EXPECT_EQ(json.at("target_reached"), true);
}

TEST(RenderReport, ErrorText) {
    cli::RenderReport report = example_render();
    set_error(report, infinity, 0.0, infinity);
    EXPECT_EQ(cli::error_text(report), "error unknown");
    set_sample_count(report.stats, 15);
    EXPECT_EQ(cli::error_text(report), "error unknown with fewer than 16 samples");
    set_sample_count(report.stats, 32);
    set_error(report, 0.0042, 0.0040, 0.0044);
    EXPECT_EQ(cli::error_text(report), "error 0.42% (0.4% to 0.44%)");
    report.target_error = 0.0044;
    EXPECT_EQ(cli::error_text(report), "error 0.42% (0.4% to 0.44%); target reached after 32 samples");
    report.requested_sample_count = 32;
    report.target_error = 0.0043; // between the estimate and its upper bound
    EXPECT_EQ(cli::error_text(report), "error 0.42% (0.4% to 0.44%); target not reached: 0.44% is above 0.43% after 32 "
                                       "samples, raise --spp");
    report.requested_sample_count = 64; // a signal came: more were allowed
    EXPECT_TRUE(cli::error_text(report).ends_with("0.44% is above 0.43% after 32 samples"));
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
    EXPECT_TRUE(cli::error_text(report).ends_with("target reached after 37.3 (16 to 64) samples"));
    report.target_error = 0.0043;
    EXPECT_TRUE(cli::error_text(report).ends_with("after 37.3 (16 to 64) samples, raise --spp"));
}

TEST(RenderReport, ACropIsToldWithItsPlace) {
    cli::RenderReport report = example_render();
    EXPECT_TRUE(cli::stats_json(report).at("crop").is_null());
    report.window.part = {10, 20, 40, 30};
    EXPECT_EQ(cli::stats_json(report).at("crop").dump(), "[10,20,40,30]");
    EXPECT_EQ(cli::stats_json(report).at("samples_per_second"), 256.0 * 30.0 * 32.0 / 2.0); // whole rows are rendered
    EXPECT_EQ(cli::summary_text(report), "40x30 at 10,20 of 256x128, 32 spp in 2.50 s on a device");
}

TEST(RenderReport, AnUncertainErrorIsCalledSo) {
    cli::RenderReport report = example_render();
    set_error(report, 0.0042, 0.0040, 0.0044);
    EXPECT_EQ(cli::stats_json(report).at("uncertain"), nlohmann::json::array());
    const auto text_with = [&](std::uint32_t uncertain) {
        report.error.uncertain = uncertain;
        return cli::error_text(report);
    };
    EXPECT_EQ(text_with(PT_UNCERTAIN_RMSE), "error 0.42% (0.4% to 0.44%)"); // the relative one is known
    EXPECT_EQ(text_with(PT_UNCERTAIN_RELATIVE_RMSE),
              "error 0.42% (0.4% to 0.44%), uncertain: a few bright pixels make most of it, more samples tell");
    EXPECT_EQ(text_with(PT_UNCERTAIN_UNSEEN),
              "error 0.42% (0.4% to 0.44%), uncertain: dark pixels may have light of brighter ones beside them that no "
              "sample has met, more samples tell");
    EXPECT_EQ(text_with(15), "error 0.42% (0.4% to 0.44%), uncertain: few samples meet small lamps, more samples tell");
    set_error(report, infinity, 0.0, infinity);
    EXPECT_EQ(cli::error_text(report), "error unknown, uncertain: few samples meet small lamps, more samples tell");
    EXPECT_EQ(cli::stats_json(report).at("uncertain"),
              (std::vector<std::string>{"rmse", "relative_rmse", "unseen", "unmet"}));
}

struct Attributes {
    std::map<std::string, std::string> texts;
    std::map<std::string, double> numbers;
};

Attributes attributes_of(const cli::RenderReport &report, const cli::ToneMap *tone_map) {
    Attributes found;
    for (const auto &[name, value] : cli::image_metadata(report, tone_map)) {
        if (const auto *text = std::get_if<std::string>(&value))
            found.texts[name] = *text;
        else if (const auto *whole = std::get_if<std::int32_t>(&value))
            found.numbers[name] = *whole;
        else
            found.numbers[name] = std::get<double>(value);
    }
    return found;
}

TEST(RenderReport, MetadataKeepsAllDigits) {
    const auto [texts, numbers] = attributes_of(example_render(), nullptr);
    EXPECT_EQ(texts.at("pt.quantity"), "radiance");
    EXPECT_EQ(texts.at("pt.seed"), "18446744073709551615");
    EXPECT_EQ(texts.at("pt.firstSample"), "4294967295");
    EXPECT_EQ(texts.at("pt.rejectedSamples"), "3");
    EXPECT_EQ(texts.at("pt.sampler"), "halton-cp");
    EXPECT_EQ(texts.at("pt.estimator"), "mis");
    EXPECT_EQ(texts.at("pt.scene"), "scene.json");
    EXPECT_EQ(texts.at("pt.device"), "a device");
    EXPECT_EQ(texts.at("software"), "pt " + cli::version_text());
    EXPECT_EQ(numbers.at("samplesPerPixel"), 32.0);
    EXPECT_EQ(numbers.at("pt.maxPathLength"), 6.0);
}

TEST(RenderReport, MetadataSayWhatWasMadeForADisplay) {
    const Attributes linear = attributes_of(example_render(), nullptr);
    for (const char *name : {"pt.toneMap", "pt.exposure", "pt.encoding", "pt.gamma"}) {
        EXPECT_EQ(linear.texts.count(name) + linear.numbers.count(name), 0U) << name;
    }
    cli::ToneMap map{-2.5, cli::ToneCurve::agx, std::nullopt};
    const Attributes mapped = attributes_of(example_render(), &map);
    EXPECT_EQ(mapped.texts.at("pt.quantity"), "tone-mapped radiance");
    EXPECT_EQ(mapped.texts.at("pt.toneMap"), "agx");
    EXPECT_EQ(mapped.texts.at("pt.encoding"), "sRGB");
    EXPECT_EQ(mapped.numbers.at("pt.exposure"), -2.5);
    map.gamma = 2.2;
    const Attributes power = attributes_of(example_render(), &map);
    EXPECT_EQ(power.numbers.at("pt.gamma"), 2.2);
    EXPECT_EQ(power.texts.count("pt.encoding"), 0U);
}

TEST(RenderReport, MetadataOfEqualRunsAreEqual) {
    cli::RenderReport report = example_render();
    report.scene = "folder/scene.json";
    const Attributes first = attributes_of(report, nullptr);
    EXPECT_EQ(first.texts.at("pt.scene"), "scene.json");
    EXPECT_EQ(first.texts.count("DateTime"), 0U);
    report.scene = "elsewhere/scene.json";
    report.create_seconds += 1.0;
    report.accumulate_seconds += 1.0;
    report.total_seconds += 1.0;
    report.stats.device_seconds += 1.0;
    report.stats.submit_count += 1;
    const Attributes second = attributes_of(report, nullptr);
    EXPECT_EQ(first.texts, second.texts);
    EXPECT_EQ(first.numbers, second.numbers);
}

TEST(RenderReport, MetadataStateTheErrorIfItIsKnown) {
    cli::RenderReport report = example_render();
    set_error(report, infinity, 0.0, infinity);
    EXPECT_EQ(attributes_of(report, nullptr).numbers.count("pt.relativeError"), 0U);
    set_error(report, 0.0042, 0.0040, 0.0044);
    EXPECT_EQ(attributes_of(report, nullptr).numbers.at("pt.relativeError"), 0.0042);
}

TEST(RenderReport, Texts) {
    EXPECT_EQ(cli::summary_text(example_render()), "256x128, 32 spp in 2.50 s on a device");
    const std::uint8_t uuid[16] = {0x00, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77,
                                   0x88, 0x99, 0xaa, 0xbb, 0xcc, 0xdd, 0xee, 0xff};
    EXPECT_EQ(cli::uuid_text(uuid), "00112233-4455-6677-8899-aabbccddeeff");
}

TEST(RenderReport, BytesAreToldInTheirUnit) {
    EXPECT_EQ(cli::memory_text(0), "0 B");
    EXPECT_EQ(cli::memory_text(1023), "1023 B");
    EXPECT_EQ(cli::memory_text(1024), "1.0 KiB");
    EXPECT_EQ(cli::memory_text(15840), "15.5 KiB");
    EXPECT_EQ(cli::memory_text((1 << 20) - 1), "1.0 MiB"); // and not 1024.0 KiB
    EXPECT_EQ(cli::memory_text((1 << 20) - 60), "1023.9 KiB");
    EXPECT_EQ(cli::memory_text(std::uint64_t{3} << 30), "3.0 GiB");
    EXPECT_EQ(cli::memory_text(std::uint64_t{5} << 40), "5.0 TiB");
    EXPECT_EQ(cli::memory_text(std::numeric_limits<std::uint64_t>::max()), "16.0 EiB");
}

} // namespace
