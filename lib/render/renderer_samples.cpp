// How a renderer takes samples: as many as are asked for, or until an error is reached; see renderer.h.
#include "lib/base/error.h"
#include "lib/film/adaptive_plan.h"
#include "lib/kernel/gpu_scene.h"
#include "lib/render/kernels_kept.h"
#include "lib/render/renderer.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace pt {

namespace {

Error too_many_samples(std::uint32_t sample_count, const std::string &reason, std::uint64_t number) {
    return {PT_ERROR_INVALID_ARGUMENT, BrokenRule{.subject = "accumulate",
                                                  .member = "sample_count",
                                                  .value = std::to_string(sample_count),
                                                  .rule = reason + std::to_string(number) + ")"}};
}

// Samples of all pixels together, the most that there may be; at least one, for shares of it.
std::uint64_t amount_of(const SamplesWanted &wanted, const TileGrid &grid) {
    std::uint64_t amount = 0;
    for (std::size_t tile = 0; tile < wanted.by_tile.size(); ++tile)
        amount += wanted.by_tile[tile] * grid.pixels(tile).pixel_count();
    if (wanted.by_tile.empty())
        amount = std::uint64_t{wanted.count} * grid.width * grid.height;
    return std::max<std::uint64_t>(amount, 1);
}

} // namespace

// The next sample is the first from first_sample on that the film lacks.
void Renderer::require_room_for(std::uint32_t sample_count) const {
    const std::uint64_t first = settings_->first_sample;
    for (const SampleSet &samples : samples_.sets()) {
        const std::uint64_t missing = sample_index_end - first - (samples.count() - samples.count_below(first));
        if (sample_count > missing)
            throw too_many_samples(sample_count, "sample indices would pass 2^32 (the next is ",
                                   samples.next_missing(first).first);
        if (sample_count > UINT32_MAX - samples.count())
            throw too_many_samples(sample_count, "a pixel holds at most 2^32 - 1 samples (it has ", samples.count());
    }
}

// Tiles are told apart where an error is asked for, on devices whose films have whole tiles.
bool Renderer::is_adaptive(const SamplesWanted &wanted) const {
    return wanted.target_error > 0.0 && wanted.sampling != PT_SAMPLING_UNIFORM &&
           std::ranges::all_of(devices_, [](const auto &device) { return device->has_whole_regions(); });
}

void Renderer::require_tiles(const SamplesWanted &wanted) const {
    if (wanted.by_tile.empty())
        return;
    const std::size_t count = samples_.grid().count();
    if (wanted.by_tile.size() != count)
        throw Error(PT_ERROR_INVALID_ARGUMENT,
                    BrokenRule{.subject = "accumulate",
                               .member = "tile_count",
                               .value = std::to_string(wanted.by_tile.size()),
                               .rule = "must be the number of tiles, " + std::to_string(count)});
    if (!std::ranges::all_of(devices_, [](const auto &device) { return device->has_whole_regions(); }))
        throw Error(PT_ERROR_UNSUPPORTED, "accumulate.tile_samples: this device holds films in parts that cut tiles");
}

void Renderer::begin(const SamplesWanted &wanted, const Progress &progress, bool is_polled) {
    cancellation_.begin();
    try {
        make_job(wanted, progress, is_polled);
    } catch (...) {
        end_job(); // nothing has been begun
        throw;
    }
}

// Of samples that are polled all kernels are built here, of others when they are needed.
void Renderer::make_job(const SamplesWanted &wanted, const Progress &progress, bool is_polled) {
    require_settings();
    require_tiles(wanted);
    require_room_for(wanted.count);
    for (const auto &device : devices_)
        device->prepare(gpu_scene_of_settings(), *settings_);
    if (is_polled) {
        const bool by_tile = is_adaptive(wanted) || !wanted.by_tile.empty() || !samples_.even();
        for (const auto &device : devices_)
            device->prepare_for_polls(by_tile, wanted.target_error > 0.0);
        view_.prepare();
    }
    const std::uint64_t most = samples_.most() + wanted.count;
    const std::uint64_t apart_from = is_adaptive(wanted) ? adaptive_from() : most;
    Job job{wanted, progress, most, std::min(most, apart_from), nullptr, nullptr, {}};
    const bool is_even = wanted.by_tile.empty() && samples_.even() && samples_.of(0).count() < job.even_count;
    if (is_even)
        job.even = std::make_unique<Accumulation>(devices_, samples_.of(0), settings_->first_sample, wanted.count,
                                                  progress, cancellation_, work_);
    job_ = std::move(job);
    if (!is_even)
        tell_tiles_apart();
}

void Renderer::end_job() noexcept {
    job_.reset();
    cancellation_.end();
}

// A look takes the time of more samples where paths are short.
std::uint64_t Renderer::adaptive_from() const {
    const std::uint64_t samples = devices_.front()->device().policy().adaptive_from;
    return settings_->max_path_length > 2 ? samples : 4 * samples;
}

// What is left of an even film: a pass, of which it has nothing yet, and splits that have moved while a device took no
// samples.
void Renderer::tell_tiles_apart() {
    for (const auto &device : devices_) {
        device->film();
        if (!device->pass().empty())
            device->discard_pass();
        device->fold_to(samples_.hull());
    }
    forget_error(); // of an even film, without those of tiles
    if (!is_adaptive(job_->wanted))
        for (std::size_t tile = 0; tile < samples_.grid().count(); ++tile)
            job_->goals.push_back(samples_.of(tile).count() +
                                  (job_->wanted.by_tile.empty() ? job_->wanted.count : job_->wanted.by_tile[tile]));
    job_->uneven = std::make_unique<TileAccumulation>(
        devices_, samples_, settings_->first_sample,
        SampleDealing::Amount{amount_of(job_->wanted, samples_.grid()), job_->even ? job_->even->pixels_done() : 0},
        job_->progress, cancellation_, work_);
    job_->even.reset();
}

Renderer::Advance Renderer::go_on(std::uint64_t nanoseconds) {
    using Clock = SampleDealing::Clock;
    const Clock::time_point now = Clock::now();
    const auto most = static_cast<std::uint64_t>((Clock::time_point::max() - now).count());
    try {
        const pt_result result = advance(now + std::chrono::nanoseconds(std::min(nanoseconds, most)));
        const Advance advanced{result, job_->dealing().fraction()};
        if (result != PT_PENDING)
            end_job();
        return advanced;
    } catch (...) {
        give_up();
        throw;
    }
}

pt_result Renderer::accumulate(const SamplesWanted &wanted, const Progress &progress) {
    const KernelsKept kept(devices_);
    begin(wanted, progress, false);
    return go_on(UINT64_MAX).result;
}

pt_result Renderer::start(const SamplesWanted &wanted) {
    const KernelsKept kept(devices_);
    begin(wanted, {nullptr, nullptr}, true);
    return go_on(0).result;
}

Renderer::Advance Renderer::poll(std::uint64_t nanoseconds) {
    require_under_way();
    const KernelsKept kept(devices_);
    return go_on(nanoseconds);
}

void Renderer::require_under_way() const {
    if (!job_)
        throw Error(PT_ERROR_INVALID_STATE, nothing_under_way);
}

// With a target error in runs, from each number of samples at which the error is looked at to the next.
Accumulation::Goal Renderer::next_goal() const {
    const bool has_target = job_->wanted.target_error > 0.0;
    const std::uint64_t check = has_target ? next_check(samples_.of(0).count()) : job_->even_count;
    if (check < job_->even_count)
        return {check, scene_->film_unit};
    return {job_->even_count, std::nullopt};
}

pt_result Renderer::advance(SampleDealing::Clock::time_point until) {
    if (job_->even) {
        const pt_result result = advance_evenly(until);
        if (result != PT_OK || job_->even_count == job_->most)
            return result;
        tell_tiles_apart();
    }
    return advance_tiles(until);
}

pt_result Renderer::advance_evenly(SampleDealing::Clock::time_point until) {
    Accumulation &accumulation = *job_->even;
    const std::uint64_t wanted = job_->even_count;
    while (samples_.of(0).count() < wanted) {
        if (!accumulation.is_under_way() && !is_in_pass() && is_on_target(job_->wanted.target_error))
            return PT_TARGET_REACHED;
        if (!accumulation.run(next_goal(), until))
            return PT_PENDING;
        take_over(samples_of_job());
        const bool is_whole = samples_.of(0).count() == job_->most;
        if (accumulation.stopped() && !is_whole)
            return PT_CANCELLED;
    }
    return PT_OK;
}

pt_result Renderer::advance_tiles(SampleDealing::Clock::time_point until) {
    for (;;) {
        TileAccumulation &accumulation = *job_->uneven;
        if (!accumulation.is_under_way()) {
            if (const std::optional<pt_result> result = next_tiles())
                return *result;
        }
        if (!accumulation.run(until))
            return PT_PENDING;
        take_over(samples_of_job());
        if (accumulation.stopped())
            return PT_CANCELLED;
    }
}

// Decides what is done next, or that nothing is.
std::optional<pt_result> Renderer::next_tiles() {
    const auto unless_done = [](bool goes_on) { return goes_on ? std::nullopt : std::optional<pt_result>(PT_OK); };
    if (!job_->goals.empty()) {
        std::vector<std::uint32_t> all(samples_.grid().count());
        std::iota(all.begin(), all.end(), 0U);
        return unless_done(job_->uneven->set_goal(all, [&](std::uint32_t tile) { return job_->goals[tile]; }));
    }
    // A film whose tiles are not to be told apart yet comes here if it may take no sample.
    if (samples_.even() && samples_.of(0).count() < adaptive_from())
        return PT_OK;
    const auto look_at_tiles = [&] { return tile_squares(); };
    const auto look = [&] {
        const ErrorEstimate &error = this->error();
        return AdaptivePlan::Error{error.relative_rmse.high, (error.uncertain & PT_UNCERTAIN_UNSEEN) != 0};
    };
    const AdaptivePlan plan(job_->wanted.target_error, job_->most, look, look_at_tiles);
    const std::optional<TileStep> step = plan.next(samples_, round_);
    if (!step)
        return PT_TARGET_REACHED;
    return unless_done(job_->uneven->set_goal(step->tiles, step->goal));
}

// The whole ones that the films hold. Nothing may be under way.
TileSamples Renderer::samples_of_job() {
    return job_->even ? TileSamples(samples_.grid(), job_->even->samples()) : job_->uneven->tidy_samples();
}

void Renderer::take_over(TileSamples samples) noexcept {
    samples_ = std::move(samples);
    forget_error();
    if (job_ && job_->uneven)
        for (const auto &device : devices_)
            device->cover(samples_.hull());
}

void Renderer::forget_error() noexcept {
    error_.reset();
    rejected_samples_.reset();
}

// What has been begun is completed, so that the films hold whole samples. Where that fails too, they are void.
void Renderer::give_up() noexcept {
    try {
        if (job_->dealing().complete())
            take_over(samples_of_job());
        else
            discard_samples();
    } catch (...) {
        discard_samples();
    }
    end_job();
}

} // namespace pt
