// The measurements of `pt bench`: the reference, which is rendered first, and one timed run after the other.
#pragma once

#include "cli/base/context.h"
#include "cli/base/progress.h"
#include "cli/bench/bench_report.h"
#include "cli/scene/render_settings.h"
#include "cli/scene/scene_file.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cli {

// For the progress. With a target error it is a guess: an error of 40% with one sample, which falls with their root.
std::uint32_t expected_sample_count(const BenchCell &cell);

// On a context that has its scene and camera. Every function returns nothing once a signal has come.
class BenchRunner {
public:
    // The file and the settings: whose fault it is if the library refuses something. total_sample_count: of all that
    // will be asked for, for the progress.
    BenchRunner(const Context &context, const SceneFile &file, const RenderSettings &settings, Progress &progress,
                std::uint64_t total_sample_count);

    // With the best sampler and estimator and the seed of the settings; noise receives an estimate of its own error.
    std::optional<std::vector<float>> render_reference(std::uint32_t sample_count, ImageError &noise);

    std::optional<BenchRun> measure(const BenchCell &cell, std::uint64_t seed, std::span<const float> reference);

private:
    void set_render(const BenchCell &cell, std::uint64_t seed);
    bool warm_up(const BenchCell &cell);
    bool accumulate(const BenchCell &cell);
    pt_result take(const pt_accumulate_info &info) const;

    const Context &context_;
    const SceneFile &file_;
    const RenderSettings &settings_;
    Progress &progress_;
    double total_sample_count_;
    double done_sample_count_ = 0.0;
};

} // namespace cli
