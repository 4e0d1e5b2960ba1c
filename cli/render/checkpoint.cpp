#include "cli/render/checkpoint.h"

#include "cli/film/film.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <system_error>

namespace cli {
namespace {

// A run takes samples in order, so a checkpoint must have the first ones.
void require_first_samples(const std::string &path, const std::vector<pt_sample_range> &ranges,
                           const RenderTask &task) {
    const std::uint64_t first = task.render.first_sample;
    const pt_sample_range wanted{first, first + task.sample_count};
    refuse_if(ranges.size() != 1 || ranges.front().first != wanted.first || ranges.front().end > wanted.end,
              path + ": has the samples " + ranges_text(ranges) + ", which are not the first ones of " +
                  ranges_text({wanted}) + ", the samples of --first-sample and --spp");
}

} // namespace

Checkpoint::Checkpoint(const Context &context, std::string path, double seconds,
                       std::function<void(const std::string &)> say) :
    context_(context),
    path_(std::move(path)),
    interval_(seconds),
    say_(std::move(say)),
    due_(Clock::now() + std::chrono::duration_cast<Clock::duration>(interval_)) {}

void Checkpoint::step(std::uint32_t sample_count) {
    if (is_due() && sample_count > saved_count_)
        save(sample_count);
}

bool Checkpoint::finish(std::uint32_t sample_count) {
    take_in();
    if (sample_count > 0 && sample_count != written_count_) {
        save(sample_count);
        take_in();
    }
    return sample_count > 0 && sample_count == written_count_;
}

// Schedules the next save early by the time of a write, so that complete files are one interval apart.
void Checkpoint::save(std::uint32_t sample_count) {
    take_in();
    saved_at_ = Clock::now();
    due_ = saved_at_ + std::chrono::duration_cast<Clock::duration>(std::max(interval_ - write_time_, interval_ / 2));
    try {
        save_film(context_, film_);
    } catch (const std::bad_alloc &) {
        tell_failure("no memory for it");
        return;
    }
    saved_count_ = sample_count;
    task_.start([this] { write(); });
}

void Checkpoint::write() {
    write_film_file(path_, film_);
    write_time_ = Clock::now() - saved_at_;
}

void Checkpoint::take_in() {
    if (!task_.is_begun())
        return;
    try {
        task_.finish();
        written_count_ = saved_count_;
    } catch (const Failure &failure) {
        tell_failure(failure.what());
    } catch (const std::bad_alloc &) {
        tell_failure("no memory for it");
    }
}

void Checkpoint::tell_failure(const std::string &reason) {
    if (!has_told_failure_)
        say_("no checkpoint: " + reason + "; the rendering continues");
    has_told_failure_ = true;
}

std::uint32_t resume(const Context &context, const RenderTask &task) {
    const std::string &path = task.options.checkpoint;
    std::error_code error;
    if (!std::filesystem::exists(path, error) && !error)
        return 0;
    const std::vector<std::byte> bytes = read_film_file(path);
    const std::vector<pt_sample_range> ranges = FilmHandle(path, bytes).ranges(0);
    add_film(context, path, bytes);
    require_first_samples(path, ranges, task);
    return context.stats().sample_count;
}

} // namespace cli
