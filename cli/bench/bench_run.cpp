#include "cli/bench/bench_run.h"

#include "cli/base/interrupt.h"
#include "cli/scene/scene_setup.h"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace cli {
namespace {

// Wall clock and processor time since its construction.
class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    double processor_seconds() const { return static_cast<double>(std::clock() - processor_start_) / CLOCKS_PER_SEC; }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
    std::clock_t processor_start_ = std::clock();
};

// What the library's progress callback needs: the share of the whole bench before and in the present call.
struct Share {
    Progress &progress;
    double before;
    double within;

    static std::int32_t receive(void *user, double fraction) {
        const auto *share = static_cast<Share *>(user);
        share->progress.update(share->before + share->within * fraction, Progress::Clock::now());
        return interrupt_signal() != 0 ? 1 : 0;
    }

    static std::int32_t receive_silently(void *, double) { return interrupt_signal() != 0 ? 1 : 0; }
};

} // namespace

std::uint32_t expected_sample_count(const BenchCell &cell) {
    if (cell.target_error == 0.0) {
        return cell.sample_count;
    }
    const double count = std::clamp(0.16 / (cell.target_error * cell.target_error), 1.0, 1.0 * cell.sample_count);
    return static_cast<std::uint32_t>(count);
}

BenchRunner::BenchRunner(const Context &context, const SceneFile &file, const RenderSettings &settings,
                         Progress &progress, std::uint64_t total_sample_count) :
    context_(context),
    file_(file),
    settings_(settings),
    progress_(progress),
    total_sample_count_(static_cast<double>(total_sample_count)) {}

void BenchRunner::set_render(const BenchCell &cell, std::uint64_t seed) {
    pt_render render = settings_.render;
    render.sampler = cell.sampler;
    render.estimator = cell.estimator;
    render.seed = seed;
    context_.require(pt_set_render(context_.get(), &render));
}

// Builds the kernels that are fastest for the scene, so that the measurement does not include that, and takes one
// sample, or with a target error the fewest of which an error is known.
bool BenchRunner::warm_up(const BenchCell &cell) {
    require_render(context_, file_, settings_, pt_prepare(context_.get()));
    pt_accumulate_info info{};
    info.struct_size = sizeof(pt_accumulate_info);
    info.sample_count = cell.target_error > 0.0 ? pt_next_check(0) : 1;
    info.target_error = cell.target_error;
    info.progress = &Share::receive_silently;
    take(info);
    return interrupt_signal() == 0;
}

bool BenchRunner::accumulate(const BenchCell &cell) {
    const std::uint32_t expected = expected_sample_count(cell);
    // With a target error the library's share is that of the samples at most, which says nothing.
    Share share{progress_, done_sample_count_ / total_sample_count_,
                cell.target_error > 0.0 ? 0.0 : expected / total_sample_count_};
    pt_accumulate_info info{};
    info.struct_size = sizeof(pt_accumulate_info);
    info.sample_count = cell.sample_count;
    info.target_error = cell.target_error;
    info.progress = &Share::receive;
    info.progress_user = &share;
    const pt_result result = take(info);
    done_sample_count_ += expected;
    return result != PT_CANCELLED;
}

pt_result BenchRunner::take(const pt_accumulate_info &info) const {
    const pt_result result = pt_accumulate(context_.get(), &info);
    require_render(context_, file_, settings_, result);
    return result;
}

std::optional<std::vector<float>> BenchRunner::render_reference(std::uint32_t sample_count, ImageError &noise) {
    const std::uint32_t half = sample_count / 2;
    BenchCell cell{PT_SAMPLER_BEST, PT_ESTIMATOR_BEST, half, 0.0, {}};
    set_render(cell, settings_.render.seed);
    if (!accumulate(cell)) {
        return std::nullopt;
    }
    const std::vector<float> first = context_.read_image(settings_.render);
    cell.sample_count = sample_count - half;
    if (!accumulate(cell)) {
        return std::nullopt;
    }
    std::vector<float> whole = context_.read_image(settings_.render);
    noise = noise_of_halves(first, half, whole, sample_count);
    return whole;
}

std::optional<BenchRun> BenchRunner::measure(const BenchCell &cell, std::uint64_t seed,
                                             std::span<const float> reference) {
    set_render(cell, seed);
    if (!warm_up(cell)) {
        return std::nullopt;
    }
    set_render(cell, seed); // discards the sample
    const Stopwatch stopwatch;
    if (!accumulate(cell)) {
        return std::nullopt;
    }
    BenchRun run{};
    run.seconds = stopwatch.seconds();
    run.processor_seconds = stopwatch.processor_seconds();
    run.mean_sample_count = cell.target_error > 0.0 ? context_.read_stats().mean_sample_count : cell.sample_count;
    run.error = image_error(context_.read_image(settings_.render), reference);
    return run;
}

} // namespace cli
