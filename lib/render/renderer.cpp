// The renderer's loop; see renderer.h.
#include "lib/render/renderer.h"

#include "lib/base/error.h"
#include "lib/film/adaptive_rule.h"
#include "lib/film/film.h"
#include "lib/film/film_tiles.h"
#include "lib/kernel/accuracy.h"
#include "lib/kernel/gpu_scene.h"
#include "lib/render/film_identity.h"
#include "lib/render/kernels_kept.h"
#include "lib/render/missed_lamps.h"
#include "lib/render/saved_film.h"
#include "lib/vulkan/device_choice.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <numeric>
#include <utility>

namespace pt {

namespace {

std::vector<pt_device_info> describe_all(const vulkan::Instance &instance) {
    std::vector<pt_device_info> devices;
    for (const vk::raii::PhysicalDevice &device : instance.physical_devices())
        devices.push_back(vulkan::describe(device));
    return devices;
}

Error too_many_samples(std::uint32_t sample_count, const std::string &reason, std::uint64_t number) {
    return {PT_ERROR_INVALID_ARGUMENT, BrokenRule{.subject = "accumulate",
                                                  .member = "sample_count",
                                                  .value = std::to_string(sample_count),
                                                  .rule = reason + std::to_string(number) + ")"}};
}

} // namespace

std::vector<pt_device_info> list_devices() {
    return describe_all(vulkan::Instance(Log{}, false));
}

// The code first: where it does not compile, no device is touched.
Renderer::Renderer(const CreateSettings &settings) :
    source_(settings.shader_directory),
    code_(source_.read()),
    instance_(settings.vulkan ? vulkan::Instance(settings.log, settings.vulkan->instance)
                              : vulkan::Instance(settings.log, settings.validation)) {
    if (settings.vulkan)
        use_device_of(*settings.vulkan, settings);
    else
        use_own_devices(settings);
}

void Renderer::use_own_devices(const CreateSettings &settings) {
    const std::vector<vk::raii::PhysicalDevice> devices = instance_.physical_devices();
    for (const std::size_t index : vulkan::choose_devices(describe_all(instance_), settings.device))
        for (std::uint32_t i = 0; i < settings.devices_of_each; ++i)
            add_device(devices[index], vulkan::LogicalDevice::create(devices[index]), settings);
}

void Renderer::use_device_of(const vulkan::CallerVulkan &caller, const CreateSettings &settings) {
    const vk::raii::PhysicalDevice physical_device = validated_physical_device(instance_.handle(), caller);
    add_device(physical_device, vulkan::LogicalDevice::borrow(physical_device, caller), settings);
}

void Renderer::add_device(const vk::raii::PhysicalDevice &physical_device, vulkan::LogicalDevice logical_device,
                          const CreateSettings &settings) {
    vulkan::DevicePolicy policy =
        settings.like_gpus ? vulkan::gpu_like_policy() : vulkan::default_policy(vulkan::describe(physical_device));
    policy.scene_in_constants = policy.scene_in_constants && settings.scene_kernels;
    policy.tree_from = settings.tree_from.value_or(policy.tree_from);
    policy.adaptive_from = settings.adaptive_from.value_or(policy.adaptive_from);
    devices_.push_back(std::make_unique<RenderDevice>(instance_, physical_device, std::move(logical_device), policy,
                                                      code_, settings.submit_milliseconds * 1e-3));
    devices_.back()->keep_kernels(settings.kernel_store);
    log().info([&] {
        const pt_device_info &info = devices_.back()->device().info();
        return std::string("renders on ") + info.name + " (" + info.driver + ")";
    });
}

void Renderer::require_alive() const {
    for (const auto &device : devices_)
        device->device().require_alive();
}

void Renderer::discard_samples() noexcept {
    for (const auto &device : devices_)
        device->discard_samples();
    round_ = {};
    samples_.clear();
    view_.forget_samples();
    forget_error();
}

void Renderer::set_scene(CheckedScene scene, WorkProgress &progress) {
    require_alive();
    PreparedScene prepared(std::move(scene), devices_.front()->device().policy().tree_from, scene_ ? &*scene_ : nullptr,
                           progress);
    progress.finish();
    discard_samples();
    gpu_scene_.reset();
    scene_ = std::move(prepared);
}

void Renderer::set_camera(const Camera &camera) {
    require_alive();
    discard_samples();
    gpu_scene_.reset();
    camera_ = camera;
}

void Renderer::set_render(const RenderSettings &settings) {
    require_alive();
    TileSamples none({settings.width, settings.row_count});
    const bool same_size =
        settings_ && settings.width == settings_->width && settings.row_count == settings_->row_count;
    if (!same_size) {
        std::vector<DeviceFilm> films;
        for (const auto &device : devices_)
            films.push_back(device->make_film(settings));
        view_.drop();
        for (std::size_t i = 0; i < films.size(); ++i)
            devices_[i]->set_film(std::move(films[i]));
    }
    discard_samples();
    gpu_scene_.reset();
    settings_ = settings;
    samples_ = std::move(none);
}

void Renderer::reload_shaders() {
    require_alive();
    if (source_.is_embedded())
        throw Error(PT_ERROR_INVALID_STATE, "no shader_dir: the kernels are those in the library");
    set_code(source_.read());
}

void Renderer::set_code(const KernelCode &code) {
    if (code == code_)
        return;
    const KernelsKept kept(devices_);
    std::vector<std::unique_ptr<TracePipelines>> pipelines;
    for (const auto &device : devices_)
        pipelines.push_back(device->make_pipelines(code));
    discard_samples();
    view_.drop();
    for (std::size_t i = 0; i < pipelines.size(); ++i)
        devices_[i]->set_pipelines(code, std::move(pipelines[i]));
    code_ = code;
}

void Renderer::require_settings() const {
    require_alive();
    if (!scene_)
        throw Error(PT_ERROR_INVALID_STATE, "no scene: call pt_set_scene first");
    if (!camera_)
        throw Error(PT_ERROR_INVALID_STATE, "no camera: call pt_set_camera first");
    if (!settings_)
        throw Error(PT_ERROR_INVALID_STATE, "no render settings: call pt_set_render first");
}

void Renderer::require_samples() const {
    if (samples_.empty())
        throw Error(PT_ERROR_INVALID_STATE, "no samples yet: call pt_accumulate or pt_add_film first");
}

bool Renderer::is_in_pass() const {
    return std::ranges::any_of(devices_, [](const auto &device) { return !device->pass().empty(); });
}

const ErrorEstimate &Renderer::error() {
    if (!error_ && samples_.least() < min_estimate_samples)
        error_ = unknown_error();
    if (!error_) {
        const KernelsKept kept(devices_);
        const std::uint64_t samples = samples_.total();
        ErrorEstimator estimator({settings_->width, samples_.of(0).count(), settings_->sampler,
                                  may_miss_lamps(scene_->scene, *camera_, *settings_, samples)});
        if (!samples_.even() || (job_ && job_->uneven))
            view_.estimate_tiles(estimator, scene_->film_unit, samples_, tile_squares_);
        else
            view_.estimate(estimator, scene_->film_unit, samples_, job_ && job_->even && job_->even->has_estimate());
        rejected_samples_ = estimator.rejected();
        error_ = hides_error(estimator.rejected(), samples) ? unknown_error() : estimator.result();
    }
    return *error_;
}

bool Renderer::is_on_target(double target_error) {
    return target_error > 0.0 && is_check(samples_.of(0).count()) && error().relative_rmse.high <= target_error;
}

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

const std::shared_ptr<const GpuScene> &Renderer::gpu_scene_of_settings() {
    if (!gpu_scene_)
        gpu_scene_ = std::make_shared<const GpuScene>(gpu_scene(*scene_, *camera_, *settings_));
    return gpu_scene_;
}

void Renderer::prepare() {
    require_settings();
    const KernelsKept kept(devices_);
    for (const auto &device : devices_)
        device->prepare_ahead(gpu_scene_of_settings(), *settings_);
    view_.prepare();
}

// Tiles are told apart where an error is asked for, on devices whose films have whole tiles.
bool Renderer::is_adaptive(const SamplesWanted &wanted) const {
    return wanted.target_error > 0.0 && wanted.sampling != PT_SAMPLING_UNIFORM &&
           std::ranges::all_of(devices_, [](const auto &device) { return device->has_whole_regions(); });
}

void Renderer::begin(const SamplesWanted &wanted, const Progress &progress) {
    require_settings();
    require_room_for(wanted.count);
    for (const auto &device : devices_)
        device->prepare(gpu_scene_of_settings(), *settings_);
    const std::uint64_t most = samples_.most() + wanted.count;
    const std::uint64_t apart_from = is_adaptive(wanted) ? adaptive_from() : most;
    Job job{wanted, progress, most, std::min(most, apart_from), nullptr, nullptr, {}};
    const bool is_even = samples_.even() && samples_.of(0).count() < job.even_count;
    if (is_even)
        job.even = std::make_unique<Accumulation>(devices_, samples_.of(0), settings_->first_sample, wanted.count,
                                                  progress, work_);
    job_ = std::move(job);
    if (!is_even)
        tell_tiles_apart();
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
            job_->goals.push_back(samples_.of(tile).count() + job_->wanted.count);
    const std::uint64_t pixels = std::uint64_t{samples_.grid().width} * samples_.grid().height;
    job_->uneven = std::make_unique<TileAccumulation>(
        devices_, samples_, settings_->first_sample,
        SampleDealing::Amount{job_->wanted.count * pixels, job_->even ? job_->even->pixels_done() : 0}, job_->progress,
        work_);
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
            job_.reset();
        return advanced;
    } catch (...) {
        give_up();
        throw;
    }
}

pt_result Renderer::accumulate(const SamplesWanted &wanted, const Progress &progress) {
    const KernelsKept kept(devices_);
    begin(wanted, progress);
    return go_on(UINT64_MAX).result;
}

pt_result Renderer::start(const SamplesWanted &wanted) {
    const KernelsKept kept(devices_);
    begin(wanted, {nullptr, nullptr});
    return go_on(0).result;
}

Renderer::Advance Renderer::poll(std::uint64_t nanoseconds) {
    require_under_way();
    const KernelsKept kept(devices_);
    return go_on(nanoseconds);
}

void Renderer::cancel() {
    require_under_way();
    job_->dealing().stop();
}

void Renderer::require_under_way() const {
    if (!job_)
        throw Error(PT_ERROR_INVALID_STATE, "no samples are under way: call pt_start first");
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

// Those of the tiles that are to take samples now, until the count that goal() gives for a tile, or what has been asked for.
// False if none is.
bool Renderer::set_tiles(const std::vector<std::uint32_t> &tiles,
                         const std::function<std::uint64_t(std::uint32_t)> &goal) {
    return job_->uneven->set_goal(tiles, [&](std::uint32_t tile) { return std::min(goal(tile), job_->most); });
}

bool Renderer::set_all_tiles(const std::function<std::uint64_t(std::uint32_t)> &goal) {
    std::vector<std::uint32_t> all(samples_.grid().count());
    std::iota(all.begin(), all.end(), 0U);
    return set_tiles(all, goal);
}

// Decides what is done next, or that nothing is.
std::optional<pt_result> Renderer::next_tiles() {
    const auto unless_done = [](bool goes_on) { return goes_on ? std::nullopt : std::optional<pt_result>(PT_OK); };
    if (!job_->goals.empty())
        return unless_done(set_all_tiles([&](std::uint32_t tile) { return job_->goals[tile]; }));
    const bool is_together = samples_.most() <= next_check(samples_.least());
    if (round_.number == AdaptiveRound::none && is_together)
        return next_even_tiles();
    const auto level_after = [&](std::uint32_t tile) { return next_level(samples_.of(tile).count()); };
    if (const std::vector<std::uint32_t> unfinished = unfinished_tiles(samples_); !unfinished.empty())
        return unless_done(set_tiles(unfinished, level_after));
    return next_adaptive_tiles();
}

// As long as tiles are not told apart: the error is looked at as with even samples, and at each level whether it pays to.
// Some may be on their way from one of these counts to the next.
std::optional<pt_result> Renderer::next_even_tiles() {
    const std::uint64_t count = samples_.least();
    if (samples_.even() && is_on_target(job_->wanted.target_error))
        return PT_TARGET_REACHED;
    if (samples_.even() && is_level(count)) {
        error();
        if (are_worth_telling_apart(tile_gains(samples_, tile_squares_)))
            return next_adaptive_tiles();
    }
    return set_all_tiles([&](std::uint32_t) { return next_check(count); }) ? std::nullopt
                                                                           : std::optional<pt_result>(PT_OK);
}

// The error is looked at while all tiles are at a level: the round goes on, or ends, and with the last one the samples.
std::optional<pt_result> Renderer::next_adaptive_tiles() {
    const double high = error().relative_rmse.high;
    const std::vector<double> gains = tile_gains(samples_, tile_squares_);
    std::vector<std::uint32_t> tiles = wanting_tiles(samples_, gains, round_);
    if (tiles.empty()) {
        const double target_error = job_->wanted.target_error;
        if (high <= target_error)
            return PT_TARGET_REACHED;
        round_ = round_after(round_, samples_, tile_squares_, gains, squared(high / target_error),
                             (error().uncertain & PT_UNCERTAIN_UNSEEN) != 0);
        tiles = wanting_tiles(samples_, gains, round_);
    }
    const auto level_after = [&](std::uint32_t tile) { return next_level(samples_.of(tile).count()); };
    return set_tiles(tiles, level_after) ? std::nullopt : std::optional<pt_result>(PT_OK);
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
    job_.reset();
}

ImageQuery Renderer::query(const ImageLayout &layout) const {
    const std::optional<PartCounts> counts =
        samples_.even() ? std::optional(part_counts(samples_.of(0))) : std::nullopt;
    return {layout.pixels, layout.quantity, scene_->film_unit, counts, layout.format};
}

void Renderer::readback(const Image &image) {
    require_settings();
    require_samples();
    const KernelsKept kept(devices_);
    view_.read(image, query(image.layout), samples_);
}

// A lent device is the only one, so its film holds all samples.
void Renderer::readback(const BufferImage &image) {
    require_alive();
    if (!is_on_lent_device())
        throw Error(PT_ERROR_INVALID_STATE, "the context has a device of its own: pt_create_info.vulkan lends it one");
    require_settings();
    require_samples();
    const KernelsKept kept(devices_);
    devices_.front()->buffer_writer().write(
        query(image.layout), {.buffer = std::bit_cast<VkBuffer>(image.buffer),
                              .offset = image.offset_bytes,
                              .row_bytes = image.layout.row_bytes,
                              .semaphores = {.wait = std::bit_cast<VkSemaphore>(image.wait_semaphore),
                                             .signal = std::bit_cast<VkSemaphore>(image.signal_semaphore)}});
}

FilmIdentity Renderer::identity() const {
    std::vector<pt_device_info> infos;
    for (const auto &device : devices_)
        infos.push_back(device->device().info());
    return identity_of(*scene_, *camera_, *settings_, code_, infos);
}

Rectangle Renderer::pixels() const {
    return {0, settings_->first_row, settings_->width, settings_->row_count};
}

FilmHeader Renderer::film_header() const {
    require_settings();
    require_samples();
    return {identity(), film_tiles(samples_, pixels()), round_};
}

void Renderer::save_film(const FilmHeader &header, std::span<std::byte> bytes) const {
    save(FilmView::films(devices_), samples_, header, bytes);
}

// A pass under way, of which no sample is counted yet, ends where the film brings its sample.
void Renderer::add_film(std::span<const std::byte> bytes) {
    require_settings();
    const FilmReader film(bytes);
    require_same(film.header().identity, identity());
    if (!samples_.even() || !is_even(film.header(), pixels())) {
        add_to_tiles(bytes);
        return;
    }
    require_addable(film, samples_.of(0));
    RenderDevice &device = *devices_.front();
    const SampleSet &added = film.header().tiles.front().samples;
    SampleSet all = samples_.of(0);
    all.add(added);
    TileSamples all_samples(samples_.grid(), all); // before the film has them: this may fail
    DeviceFilm &device_film = device.film();
    if (is_in_pass() && added.overlap(device.pass()))
        device.discard_pass();
    add(film, all.hull(), device.device(), device_film);
    round_ = later_of(round_, film.header().round);
    take_over(std::move(all_samples));
}

// By way of the host, where films are values.
void Renderer::add_to_tiles(std::span<const std::byte> bytes) {
    for (const auto &device : devices_)
        if (!device->has_whole_regions())
            throw Error(PT_ERROR_UNSUPPORTED,
                        "film: this device holds films in parts that cut tiles, so that all pixels "
                        "must have the same samples");
    Film sum(bytes);
    if (!samples_.empty()) {
        const FilmHeader header = film_header();
        std::vector<std::byte> own(FilmLayout(header).size_bytes());
        save_film(header, own);
        sum.add(Film(own));
    }
    require_within(sum.bounds(), pixels());
    std::optional<TileSamples> samples = tile_samples(sum.header().tiles, pixels());
    if (!samples)
        throw Error(PT_ERROR_INCOMPATIBLE,
                    "film: its tiles must be whole ones of this context, squares of 8 pixels from "
                    "the top left of what is rendered on");
    for (const auto &device : devices_)
        if (!device->pass().empty())
            device->discard_pass();
    const AdaptiveRound round = sum.header().round;
    RenderDevice &device = *devices_.front();
    replace(sum, samples->hull(), pixels(), device.device(), device.film());
    for (const auto &other : std::span(devices_).subspan(1))
        other->discard_samples();
    round_ = round;
    take_over(std::move(*samples));
}

pt_stats Renderer::stats(bool with_error) {
    const bool alive = std::ranges::none_of(devices_, [](const auto &device) { return device->device().lost(); });
    const bool readable = settings_ && alive;
    const ErrorEstimate error = with_error && readable ? this->error() : unknown_error();
    pt_stats stats{};
    stats.sample_count = static_cast<std::uint32_t>(samples_.least());
    stats.max_sample_count = static_cast<std::uint32_t>(samples_.most());
    if (settings_)
        stats.mean_sample_count =
            static_cast<double>(samples_.total()) / (1.0 * settings_->width * settings_->row_count);
    stats.submit_count = work_.submit_count;
    stats.device_seconds = work_.seconds;
    for (const auto &device : devices_) {
        if (readable && !samples_.empty() && !rejected_samples_)
            stats.rejected_samples += device->film().rejected_samples();
        stats.device_bytes += device->device().allocated_bytes();
    }
    stats.rejected_samples += rejected_samples_.value_or(0);
    stats.features = gpu_scene_ ? feature_bits(gpu_scene_->features) : 0;
    stats.device_count = static_cast<std::uint32_t>(devices_.size());
    stats.rmse = error.rmse.estimate;
    stats.rmse_low = error.rmse.low;
    stats.rmse_high = error.rmse.high;
    stats.relative_rmse = error.relative_rmse.estimate;
    stats.relative_rmse_low = error.relative_rmse.low;
    stats.relative_rmse_high = error.relative_rmse.high;
    stats.uncertain = error.uncertain;
    return stats;
}

std::vector<pt_function_accuracy> Renderer::accuracy() {
    return measured_accuracy(devices_.front()->device(), code_.accuracy);
}

} // namespace pt
