#include "cli/render/render_task.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace {

using cli::ExitCode;
using cli::RenderOptions;
using cli::RenderTask;

constexpr const char *short_scene = "{\n\"render\": {\"max_path_length\": 3, \"spp\": 5}}";

RenderTask task_of(const RenderOptions &options, const char *scene) {
    return {options, cli::parse_scene(scene, "s.json", options.overrides)};
}

TEST(RenderTask, ATargetErrorRaisesTheDefaultNumberOfSamplesAlone) {
    RenderOptions options;
    EXPECT_EQ(task_of(options, "{}").sample_count, 64U);
    options.stopping.target_error = 0.005;
    EXPECT_EQ(task_of(options, "{}").sample_count, 65536U);
    EXPECT_EQ(task_of(options, short_scene).sample_count, 5U);
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
    RenderOptions size_only;
    size_only.overrides = {{{{"film"}, {"width"}}, 1, "--size: width", PT_ERROR_INVALID_ARGUMENT, true}};
    EXPECT_EQ(explained(size_only, {size, length}, short_scene),
              std::pair(ExitCode::usage, std::string("--size: width = 0: must be >= 1\n"
                                                     "s.json:2: render.max_path_length = 2000: must be <= 1024")));
    EXPECT_EQ(explained({}, {{"render", none, "width", none, "* rows", "512 * 1", "too many"}}, "{}"),
              std::pair(ExitCode::usage, std::string("--size: width * rows = 512 * 1: too many")));
}

} // namespace
