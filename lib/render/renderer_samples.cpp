#include "lib/base/error.h"
#include "lib/film/adaptive_rule.h"
#include "lib/render/renderer.h"

#include <algorithm>
#include <chrono>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace pt {

namespace {

std::uint64_t amount_of(const pt_accumulate_info &wanted, const TileGrid &grid) {
    return wanted.tile_samples == nullptr
               ? std::uint64_t{wanted.sample_count} * grid.count()
               : std::accumulate(wanted.tile_samples, wanted.tile_samples + wanted.tile_count, std::uint64_t{0});
}

} // namespace

void Renderer::require_room_for(std::uint32_t sample_count) const {
    const std::uint64_t first = settings_->first_sample;
    for (const SampleSet &samples : samples_.sets()) {
        const std::uint64_t missing = sample_index_end - first - (samples.count() - samples.count_below(first));
        if (sample_count > missing)
            refuse_argument("accumulate", "sample_count", std::to_string(sample_count),
                            "sample indices would pass 2^32 (the next is " +
                                std::to_string(samples.next_missing(first).first) + ")");
        if (sample_count > UINT32_MAX - samples.count())
            refuse_argument("accumulate", "sample_count", std::to_string(sample_count),
                            "a pixel holds at most 2^32 - 1 samples (it has " + std::to_string(samples.count()) + ")");
    }
}

void Renderer::require_tiles(const pt_accumulate_info &wanted) const {
    const std::size_t tiles = samples_.grid().count();
    if (wanted.tile_samples != nullptr && wanted.tile_count != tiles)
        refuse_argument("accumulate", "tile_count", std::to_string(wanted.tile_count),
                        "must be the number of tiles, " + std::to_string(tiles));
}

void Renderer::begin(const pt_accumulate_info &wanted, bool is_polled) {
    cancellation_.begin();
    try {
        make_job(wanted, is_polled);
    } catch (...) {
        end_job();
        throw;
    }
}

// If `is_polled`, builds all kernels now.
void Renderer::make_job(const pt_accumulate_info &wanted, bool is_polled) {
    const Stopping stopping{wanted.stopping};
    require_settings();
    require_tiles(wanted);
    require_room_for(wanted.sample_count);
    for (const auto &device : devices_)
        device->prepare(view(), *settings_);
    if (is_polled) {
        for (const auto &device : devices_)
            device->prepare_for_polls(stopping.has_target());
        film_view_.prepare();
    }
    const bool is_adaptive = stopping.has_target() && wanted.sampling != PT_SAMPLING_UNIFORM;
    const std::uint32_t *const of_tiles = wanted.tile_samples;
    const std::uint64_t most = samples_.most() + wanted.sample_count;
    const std::uint64_t together_to = is_adaptive ? std::min(most, adaptive_from()) : most;
    const bool is_together =
        of_tiles == nullptr && samples_.even() && (!is_adaptive || samples_.of(0).count() < together_to);
    std::vector<std::uint64_t> goals;
    if (!is_together && !is_adaptive)
        for (std::size_t tile = 0; tile < samples_.grid().count(); ++tile)
            goals.push_back(samples_.of(tile).count() + (of_tiles != nullptr ? of_tiles[tile] : wanted.sample_count));
    // NOLINTNEXTLINE(modernize-make-unique): an aggregate, which cannot be moved
    job_.reset(new Job{stopping,
                       {most, std::max<std::uint64_t>(most, wanted.sample_limit)},
                       together_to,
                       is_together,
                       std::move(goals),
                       {devices_,
                        samples_,
                        settings_->first_sample,
                        amount_of(wanted, samples_.grid()),
                        {wanted.progress, wanted.progress_user},
                        stopping,
                        cancellation_,
                        work_}});
}

void Renderer::end_job() noexcept {
    job_.reset();
    cancellation_.end();
}

// With short paths an error check takes much longer than a sample, so tiles keep equal counts for longer.
std::uint64_t Renderer::adaptive_from() const {
    const std::uint64_t samples = devices_.front()->device().policy().adaptive_from;
    return settings_->max_path_length > 2 ? samples : 4 * samples;
}

Renderer::Advance Renderer::go_on(std::uint64_t nanoseconds) {
    using Clock = Accumulation::Clock;
    const Clock::time_point now = Clock::now();
    const auto most = static_cast<std::uint64_t>((Clock::time_point::max() - now).count());
    try {
        const pt_result result = advance(now + std::chrono::nanoseconds(std::min(nanoseconds, most)));
        const Advance advanced{result, job_->accumulation.fraction()};
        if (result != PT_PENDING)
            end_job();
        return advanced;
    } catch (...) {
        give_up();
        throw;
    }
}

pt_result Renderer::accumulate(const pt_accumulate_info &wanted) {
    const KernelsKept kept(devices_);
    begin(wanted, false);
    return go_on(UINT64_MAX).result;
}

pt_result Renderer::start(const pt_accumulate_info &wanted) {
    const KernelsKept kept(devices_);
    begin(wanted, true);
    return go_on(0).result;
}

Renderer::Advance Renderer::poll(std::uint64_t nanoseconds) {
    if (!job_)
        throw Error(PT_ERROR_INVALID_STATE, nothing_under_way);
    const KernelsKept kept(devices_);
    return go_on(nanoseconds);
}

pt_result Renderer::advance(Accumulation::Clock::time_point until) {
    Accumulation &accumulation = job_->accumulation;
    for (;;) {
        if (!accumulation.is_under_way()) {
            if (const std::optional<pt_result> result = next_step())
                return *result;
        }
        if (!accumulation.run(until))
            return PT_PENDING;
        take_over(accumulation.samples());
        const bool is_complete = job_->is_together && samples_.least() == job_->counts.most;
        if (accumulation.stopped() != PT_OK && !is_complete)
            return accumulation.stopped();
    }
}

// Returns no value if a step has begun, otherwise the result.
std::optional<pt_result> Renderer::next_step() {
    const auto unless_done = [](bool goes_on) { return goes_on ? std::nullopt : std::optional<pt_result>(PT_OK); };
    if (job_->is_together && samples_.of(0).count() < job_->together_to)
        return next_step_together();
    if (job_->is_together && job_->together_to == job_->counts.most)
        return PT_OK;
    job_->is_together = false;
    if (!job_->goals.empty())
        return unless_done(job_->accumulation.set_goal_of_all([&](std::uint32_t tile) { return job_->goals[tile]; }));
    // The limits allow too few samples for adaptive sampling.
    if (samples_.even() && samples_.of(0).count() < adaptive_from())
        return PT_OK;
    const AdaptivePlan plan(
        job_->stopping, job_->counts,
        {[&] { return error(); }, [&] { return tile_squares(); }, [&] { return samples_for_lamps(); }});
    const std::optional<TileStep> step = plan.next(samples_, round_);
    if (!step)
        return PT_TARGET_REACHED;
    return unless_done(job_->accumulation.set_goal(step->tiles, step->goal));
}

std::optional<pt_result> Renderer::next_step_together() {
    const std::uint64_t count = samples_.of(0).count();
    if (is_on_target())
        return PT_TARGET_REACHED;
    const std::uint64_t check = job_->stopping.has_target() ? next_check(count) : job_->together_to;
    const bool is_looked_at = check < job_->together_to;
    job_->accumulation.set_goal_of_all(std::min(check, job_->together_to),
                                       is_looked_at ? std::optional(scene_->film_unit) : std::nullopt);
    return std::nullopt;
}

void Renderer::take_over(TileSamples samples) noexcept {
    samples_ = std::move(samples);
    forget_error();
}

void Renderer::forget_error() noexcept {
    error_.reset();
    tile_squares_.clear();
    rejected_samples_.reset();
}

// Completes begun samples, or discards all samples if this fails.
void Renderer::give_up() noexcept {
    try {
        if (job_->accumulation.complete())
            take_over(job_->accumulation.samples());
        else
            discard_samples();
    } catch (...) {
        discard_samples();
    }
    end_job();
}

} // namespace pt
