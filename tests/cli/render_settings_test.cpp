// Tests of cli/render_settings: the rank of command line, scene file and defaults, and who is to blame.
#include "cli/scene/render_settings.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using cli::ExitCode;
using cli::merge_settings;
using cli::RenderOptions;
using cli::RenderSettings;
using cli::SceneFile;

SceneFile full_scene() {
    SceneFile scene{};
    scene.width = 10;
    scene.height = 20;
    scene.max_path_length = 3;
    scene.sample_count = 5;
    scene.seed = 7;
    scene.sampler = PT_SAMPLER_RANDOM;
    scene.estimator = PT_ESTIMATOR_UNIFORM;
    return scene;
}

RenderOptions full_options() {
    RenderOptions options;
    options.size = cli::ImageSize{30, 40};
    options.max_path_length = 4;
    options.sample_count = 6;
    options.seed = 8;
    options.sampler = PT_SAMPLER_HALTON;
    options.estimator = PT_ESTIMATOR_MIS;
    options.first_sample = 9;
    return options;
}

void expect_render(const RenderSettings &settings, std::uint32_t width, std::uint32_t height, std::uint32_t length,
                   std::uint32_t samples, std::uint64_t seed, std::uint32_t sampler, std::uint32_t estimator) {
    EXPECT_EQ(settings.render.struct_size, sizeof(pt_render));
    EXPECT_EQ(settings.render.width, width);
    EXPECT_EQ(settings.render.height, height);
    EXPECT_EQ(settings.render.max_path_length, length);
    EXPECT_EQ(settings.sample_count, samples);
    EXPECT_EQ(settings.render.seed, seed);
    EXPECT_EQ(settings.render.sampler, sampler);
    EXPECT_EQ(settings.render.estimator, estimator);
}

TEST(RenderSettings, CommandLineBeatsSceneBeatsDefaults) {
    expect_render(merge_settings({}, {}), 512, 512, 6, 64, 0, PT_SAMPLER_BEST, PT_ESTIMATOR_BEST);
    expect_render(merge_settings({}, full_scene()), 10, 20, 3, 5, 7, PT_SAMPLER_RANDOM, PT_ESTIMATOR_UNIFORM);
    expect_render(merge_settings(full_options(), full_scene()), 30, 40, 4, 6, 8, PT_SAMPLER_HALTON, PT_ESTIMATOR_MIS);
    EXPECT_EQ(merge_settings(full_options(), {}).render.first_sample, 9U);
}

TEST(RenderSettings, ATargetErrorRaisesTheDefaultNumberOfSamplesAlone) {
    EXPECT_EQ(merge_settings({}, {}).target_error, 0.0);
    RenderOptions options;
    options.target_error = 0.005;
    EXPECT_EQ(merge_settings(options, {}).target_error, 0.005);
    EXPECT_EQ(merge_settings(options, {}).sample_count, 65536U);
    EXPECT_EQ(merge_settings(options, full_scene()).sample_count, 5U);
    options.sample_count = 6;
    EXPECT_EQ(merge_settings(options, full_scene()).sample_count, 6U);
}

TEST(RenderSettings, ToneMapping) {
    const RenderSettings none = merge_settings({}, {});
    EXPECT_FALSE(none.exposure.stops); // automatic
    EXPECT_EQ(none.tone_curve, cli::ToneCurve::none);
    EXPECT_FALSE(none.gamma);
    SceneFile scene{};
    scene.exposure = cli::Exposure{-3.0};
    scene.tone_curve = cli::ToneCurve::agx;
    scene.gamma = 2.2;
    RenderOptions options;
    EXPECT_EQ(merge_settings(options, scene).exposure.stops, -3.0);
    EXPECT_EQ(merge_settings(options, scene).tone_curve, cli::ToneCurve::agx);
    EXPECT_EQ(merge_settings(options, scene).gamma, 2.2);
    options.display.exposure = cli::Exposure{}; // "auto" on the command line counts
    options.display.tone_curve = cli::ToneCurve::none;
    options.display.gamma = 1.0;
    EXPECT_FALSE(merge_settings(options, scene).exposure.stops);
    EXPECT_EQ(merge_settings(options, scene).tone_curve, cli::ToneCurve::none);
    EXPECT_EQ(merge_settings(options, scene).gamma, 1.0);
}

TEST(RenderSettings, SamplesEndWithTheLastIndex) {
    RenderOptions options;
    options.first_sample = 4294967286U; // ten are left
    options.sample_count = 10;
    EXPECT_EQ(merge_settings(options, {}).sample_count, 10U);
    options.sample_count = 11;
    EXPECT_THROW(merge_settings(options, {}), cli::Failure);
    options.target_error = 0.01;
    EXPECT_EQ(merge_settings(options, {}).sample_count, 10U);
}

TEST(RenderSettings, AZeroSeedOnTheCommandLineCounts) {
    RenderOptions options;
    options.seed = 0;
    EXPECT_EQ(merge_settings(options, full_scene()).render.seed, 0U);
}

TEST(RenderSettings, WhatTheLibraryRefusesIsNamedAsItWasGiven) {
    constexpr std::nullopt_t none = std::nullopt;
    const cli::BrokenRule size{"render", none, "width", none, "", "0", "must be >= 1"};
    const cli::BrokenRule length{"render", none, "max_path_length", none, "", "2000", "must be <= 1024"};
    SceneFile scene = full_scene();
    scene.path = "s.json";
    const auto explained = [&](const RenderOptions &options, std::vector<cli::BrokenRule> rules,
                               const SceneFile &file) {
        const cli::LibraryError error{"a message", std::move(rules)};
        const cli::Failure failure = merge_settings(options, file).explain(error, file);
        return std::pair(failure.code(), std::string(failure.what()));
    };
    EXPECT_EQ(explained({}, {size}, scene),
              std::pair(ExitCode::scene, std::string("s.json: film.width = 0: must be >= 1")));
    EXPECT_EQ(explained({}, {length}, scene),
              std::pair(ExitCode::scene, std::string("s.json: render.max_path_length = 2000: must be <= 1024")));
    EXPECT_EQ(explained(full_options(), {size}, scene),
              std::pair(ExitCode::usage, std::string("--size: width = 0: must be >= 1")));
    EXPECT_EQ(explained(full_options(), {length}, scene),
              std::pair(ExitCode::usage, std::string("--max-path-length = 2000: must be <= 1024")));
    RenderOptions size_only;
    size_only.size = cli::ImageSize{1, 1};
    EXPECT_EQ(explained(size_only, {size, length}, scene),
              std::pair(ExitCode::usage, std::string("--size: width = 0: must be >= 1\n"
                                                     "s.json: render.max_path_length = 2000: must be <= 1024")));
    // Neither gave it.
    EXPECT_EQ(explained({}, {{"render", none, "width", none, "* rows", "512 * 1", "too many"}}, {}),
              std::pair(ExitCode::usage, std::string("--size: width * rows = 512 * 1: too many")));
}

} // namespace
