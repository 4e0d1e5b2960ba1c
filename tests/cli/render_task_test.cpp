#include "cli/render/render_task.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace {

using cli::ExitCode;
using cli::RenderOptions;
using cli::RenderTask;

constexpr const char *full_scene = R"({
  "film": { "width": 10, "height": 20, "exposure": -3, "tonemap": "agx", "gamma": 2.2 },
  "render": { "max_path_length": 3, "spp": 5, "seed": 7, "sampler": "random", "estimator": "uniform" } })";

cli::SceneOverride option(const char *name, pt::JsonPath path, nlohmann::json value) {
    return {std::move(path), std::move(value), name, PT_ERROR_INVALID_ARGUMENT, true};
}

RenderOptions full_options() {
    RenderOptions options;
    options.overrides = {option("--size: width", {{"film"}, {"width"}}, 30),
                         option("--size: height", {{"film"}, {"height"}}, 40),
                         option("--exposure", {{"film"}, {"exposure"}}, "auto"),
                         option("--tonemap", {{"film"}, {"tonemap"}}, "none"),
                         option("--max-path-length", {{"render"}, {"max_path_length"}}, 4),
                         option("--spp", {{"render"}, {"spp"}}, 6),
                         option("--seed", {{"render"}, {"seed"}}, 0),
                         option("--sampler", {{"render"}, {"sampler"}}, "halton"),
                         option("--estimator", {{"render"}, {"estimator"}}, "mis")};
    options.first_sample = 9;
    return options;
}

RenderTask task_of(const RenderOptions &options, const char *scene) {
    return {options, cli::parse_scene(scene, "s.json", options.overrides)};
}

void expect_render(const RenderTask &task, std::uint32_t width, std::uint32_t height, std::uint32_t length,
                   std::uint32_t samples, std::uint64_t seed, std::uint32_t sampler, std::uint32_t estimator) {
    EXPECT_EQ(task.render.struct_size, sizeof(pt_render));
    EXPECT_EQ(task.render.width, width);
    EXPECT_EQ(task.render.height, height);
    EXPECT_EQ(task.render.max_path_length, length);
    EXPECT_EQ(task.sample_count, samples);
    EXPECT_EQ(task.render.seed, seed);
    EXPECT_EQ(task.render.sampler, sampler);
    EXPECT_EQ(task.render.estimator, estimator);
}

TEST(RenderTask, CommandLineBeatsSceneBeatsDefaults) {
    expect_render(task_of({}, "{}"), 512, 512, 6, 64, 0, PT_SAMPLER_BEST, PT_ESTIMATOR_BEST);
    expect_render(task_of({}, full_scene), 10, 20, 3, 5, 7, PT_SAMPLER_RANDOM, PT_ESTIMATOR_UNIFORM);
    expect_render(task_of(full_options(), full_scene), 30, 40, 4, 6, 0, PT_SAMPLER_HALTON, PT_ESTIMATOR_MIS);
    EXPECT_EQ(task_of(full_options(), "{}").render.first_sample, 9U);
}

TEST(RenderTask, ToneMapping) {
    EXPECT_EQ(task_of({}, full_scene).scene.display.exposure, -3.0);
    EXPECT_EQ(task_of({}, full_scene).scene.display.automatic_exposure, 0U);
    EXPECT_EQ(task_of({}, full_scene).scene.display.curve, std::uint32_t{PT_CURVE_AGX});
    EXPECT_EQ(task_of({}, full_scene).scene.display.gamma, 2.2);
    EXPECT_EQ(task_of(full_options(), full_scene).scene.display.automatic_exposure, 1U);
    EXPECT_EQ(task_of(full_options(), full_scene).scene.display.curve, std::uint32_t{PT_CURVE_NONE});
}

TEST(RenderTask, ATargetErrorRaisesTheDefaultNumberOfSamplesAlone) {
    RenderOptions options;
    options.stopping.target_error = 0.005;
    EXPECT_EQ(task_of(options, "{}").sample_count, 65536U);
    EXPECT_EQ(task_of(options, full_scene).sample_count, 5U);
}

TEST(RenderTask, SamplesEndWithTheLastIndex) {
    RenderOptions options;
    options.first_sample = 4294967286U;
    EXPECT_EQ(task_of(options, R"({"render": {"spp": 10}})").sample_count, 10U);
    EXPECT_THROW(task_of(options, R"({"render": {"spp": 11}})"), cli::Failure);
    options.stopping.target_error = 0.01;
    EXPECT_EQ(task_of(options, "{}").sample_count, 10U);
}

TEST(RenderTask, WhatTheLibraryRefusesIsNamedAsItWasGiven) {
    constexpr int none = -1;
    const cli::BrokenRule size{"render", none, "width", none, "", "0", "must be >= 1"};
    const cli::BrokenRule length{"render", none, "max_path_length", none, "", "2000", "must be <= 1024"};
    const auto explained = [&](const RenderOptions &options, std::vector<cli::BrokenRule> rules, const char *scene) {
        const RenderTask task = task_of(options, scene);
        const cli::LibraryError error{"a message", std::move(rules)};
        return std::pair(blame(task.scene, error), explain(task.scene, error));
    };
    EXPECT_EQ(explained({}, {size}, full_scene),
              std::pair(ExitCode::scene, std::string("s.json:2: film.width = 0: must be >= 1")));
    EXPECT_EQ(explained({}, {length}, full_scene),
              std::pair(ExitCode::scene, std::string("s.json:3: render.max_path_length = 2000: must be <= 1024")));
    EXPECT_EQ(explained(full_options(), {size}, full_scene),
              std::pair(ExitCode::usage, std::string("--size: width = 0: must be >= 1")));
    EXPECT_EQ(explained(full_options(), {length}, full_scene),
              std::pair(ExitCode::usage, std::string("--max-path-length = 2000: must be <= 1024")));
    RenderOptions size_only;
    size_only.overrides = {option("--size: width", {{"film"}, {"width"}}, 1)};
    EXPECT_EQ(explained(size_only, {size, length}, full_scene),
              std::pair(ExitCode::usage, std::string("--size: width = 0: must be >= 1\n"
                                                     "s.json:3: render.max_path_length = 2000: must be <= 1024")));
    EXPECT_EQ(explained({}, {{"render", none, "width", none, "* rows", "512 * 1", "too many"}}, "{}"),
              std::pair(ExitCode::usage, std::string("--size: width * rows = 512 * 1: too many")));
}

} // namespace
