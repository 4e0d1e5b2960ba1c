// The renderer's loop; see renderer.h.
#include "renderer.h"

#include "accuracy.h"
#include "error.h"
#include "sample_halves.h"
#include "vulkan/device_choice.h"

#include <algorithm>
#include <utility>

namespace pt {

namespace {

// Ray-surface tests a second that any device manages: an eighth of what two CPU cores do. The first slice is sized by it;
// measured slices size the rest.
constexpr double assumed_tests_per_second = 2.5e8;

// Drivers may promise memory that they do not have and fail when it is touched, so the size is checked beforehand.
void require_film_memory(const RenderSettings &settings, const pt_device_info &device) {
    const std::uint64_t bytes = std::uint64_t{settings.width} * settings.height * Film::bytes_per_pixel;
    if (bytes > device.memory_bytes)
        throw Error(PT_ERROR_UNSUPPORTED, "render.width * height = " + std::to_string(settings.width) + " * " +
                                              std::to_string(settings.height) + ": the film takes " +
                                              std::to_string(bytes) + " bytes, and the device has " +
                                              std::to_string(device.memory_bytes));
}

std::vector<pt_device_info> describe_all(const vulkan::Instance &instance) {
    std::vector<pt_device_info> devices;
    for (const vk::raii::PhysicalDevice &device : instance.physical_devices())
        devices.push_back(vulkan::describe(device));
    return devices;
}

vk::raii::PhysicalDevice chosen_device(const vulkan::Instance &instance, const std::string &wanted) {
    return instance.physical_devices()[vulkan::choose_device(describe_all(instance), wanted.c_str())];
}

} // namespace

std::vector<pt_device_info> list_devices() {
    return describe_all(vulkan::Instance(Log{}, false));
}

Renderer::Renderer(const CreateSettings &settings) :
    log_(settings.log),
    instance_(log_, settings.validation),
    device_(instance_, chosen_device(instance_, settings.device)),
    pipelines_(device_),
    target_seconds_(settings.submit_milliseconds * 1e-3) {}

void Renderer::discard_samples() {
    if (film_)
        film_->clear();
    kernel_.reset();
    samples_done_ = 0;
    pass_pixels_done_ = 0;
    error_.reset();
}

void Renderer::set_scene(Scene scene) {
    device_.require_alive();
    discard_samples();
    scene_ = std::move(scene);
}

void Renderer::set_camera(const Camera &camera) {
    device_.require_alive();
    discard_samples();
    camera_ = camera;
}

void Renderer::set_render(const RenderSettings &settings) {
    device_.require_alive();
    const bool same_size = settings_ && settings.width == settings_->width && settings.height == settings_->height;
    if (!same_size) {
        require_film_memory(settings, device_.info());
        Film film(device_, settings.width, settings.height, max_strip_pixels(device_.limits()));
        kernel_.reset(); // its descriptor sets name the old film
        film_ = std::move(film);
    }
    discard_samples();
    settings_ = settings;
}

void Renderer::require_settings() const {
    device_.require_alive();
    if (!scene_)
        throw Error(PT_ERROR_INVALID_STATE, "no scene: call pt_set_scene first");
    if (!camera_)
        throw Error(PT_ERROR_INVALID_STATE, "no camera: call pt_set_camera first");
    if (!settings_)
        throw Error(PT_ERROR_INVALID_STATE, "no render settings: call pt_set_render first");
}

void Renderer::prepare_kernel() {
    if (kernel_)
        return;
    kernel_.emplace(device_, pipelines_, *film_, *scene_, *camera_, *settings_);
    ScheduleLimits limits{};
    limits.target_seconds = target_seconds_;
    limits.first_slice_paths =
        target_seconds_ * assumed_tests_per_second / static_cast<double>(surface_tests_per_path(kernel_->features()));
    limits.max_samples = kernel_->max_samples();
    limits.pixel_granularity = gpu::WORKGROUP_SIZE;
    schedule_.emplace(film_->pixel_count(), limits);
}

double Renderer::run(const Slice &slice) {
    const double seconds = kernel_->run(slice, settings_->first_sample + samples_done_);
    ++submit_count_;
    device_seconds_ += seconds;
    return seconds;
}

// Counts what a slice has done.
void Renderer::advance(const Slice &slice) {
    const std::uint32_t slice_end = slice.first_pixel + slice.pixel_count;
    if (slice_end == film_->pixel_count()) {
        samples_done_ += slice.sample_count;
        pass_pixels_done_ = 0;
        error_.reset();
    } else {
        pass_pixels_done_ = slice_end;
    }
}

// Samples that the film holds.
HalfCounts Renderer::half_counts() const {
    HalfCounts counts{};
    for (std::uint32_t half = 0; half < gpu::FILM_HALVES; ++half)
        counts[half] =
            SampleHalves(settings_->sampler).range(half, settings_->first_sample, samples_done_).sample_count;
    return counts;
}

const ErrorEstimate &Renderer::error() {
    if (!error_ && samples_done_ < min_estimate_samples)
        error_ = unknown_error();
    if (!error_) {
        ErrorEstimator estimator(settings_->width);
        film_->read(kernel_->film_unit(), half_counts(),
                    [&](const PixelEstimates &pixels) { estimator.add(pixels.radiance, pixels.standard_error); });
        error_ = estimator.result(accuracy_of_halves(settings_->sampler, kernel_->point_layout(), samples_done_));
    }
    return *error_;
}

bool Renderer::is_on_target(double target_error) {
    return target_error > 0.0 && is_check(samples_done_) && error().relative_rmse.high <= target_error;
}

pt_result Renderer::accumulate(std::uint32_t sample_count, double target_error, const Progress &progress) {
    require_settings();
    const std::uint64_t first = std::uint64_t{settings_->first_sample} + samples_done_;
    if (first + sample_count > std::uint64_t{1} << 32)
        throw Error(PT_ERROR_INVALID_ARGUMENT, "accumulate.sample_count = " + std::to_string(sample_count) +
                                                   ": sample indices would pass 2^32 (the next is " +
                                                   std::to_string(first) + ")");
    if (sample_count > UINT32_MAX - samples_done_)
        throw Error(PT_ERROR_INVALID_ARGUMENT, "accumulate.sample_count = " + std::to_string(sample_count) +
                                                   ": a pixel holds at most 2^32 - 1 samples (it has " +
                                                   std::to_string(samples_done_) + ")");
    prepare_kernel();

    const std::uint32_t samples_before = samples_done_;
    const std::uint32_t samples_wanted = samples_done_ + sample_count;
    const double start = static_cast<double>(pass_pixels_done_) / film_->pixel_count();
    while (samples_done_ < samples_wanted) {
        if (pass_pixels_done_ == 0 && is_on_target(target_error))
            return PT_TARGET_REACHED;
        const std::uint32_t end =
            target_error > 0.0 ? std::min(samples_wanted, next_check(samples_done_)) : samples_wanted;
        const Slice slice = schedule_->next(end - samples_done_, pass_pixels_done_);
        schedule_->measured(slice, run(slice));
        advance(slice);
        if (!progress.function)
            continue;
        const double pass = static_cast<double>(pass_pixels_done_) / film_->pixel_count();
        const double done = samples_done_ - samples_before + pass - start;
        const bool stop = progress.function(progress.user, done / (sample_count - start)) != 0;
        if (stop && samples_done_ < samples_wanted)
            return PT_CANCELLED;
    }
    return PT_OK;
}

void Renderer::readback(const Image &image) {
    require_settings();
    if (samples_done_ == 0)
        throw Error(PT_ERROR_INVALID_STATE, "no samples yet: call pt_accumulate first");
    const std::size_t width = settings_->width;
    std::size_t pixel = 0;
    film_->read(kernel_->film_unit(), half_counts(), [&](const PixelEstimates &pixels) {
        const std::vector<float> &values =
            image.quantity == PT_QUANTITY_RADIANCE ? pixels.radiance : pixels.standard_error;
        for (std::size_t i = 0; i < values.size(); i += 3, ++pixel)
            std::copy_n(&values[i], 3, image.data + pixel / width * image.row_floats + pixel % width * 3);
    });
}

pt_stats Renderer::stats(bool with_error) {
    const bool readable = film_ && !device_.lost();
    const ErrorEstimate error = with_error && readable ? this->error() : unknown_error();
    pt_stats stats{};
    stats.sample_count = samples_done_;
    stats.rejected_samples = readable ? film_->rejected_samples() : 0;
    stats.device_bytes = device_.allocated_bytes();
    stats.submit_count = submit_count_;
    stats.device_seconds = device_seconds_;
    stats.features = kernel_ ? feature_bits(kernel_->features()) : 0;
    stats.rmse = error.rmse.estimate;
    stats.rmse_low = error.rmse.low;
    stats.rmse_high = error.rmse.high;
    stats.relative_rmse = error.relative_rmse.estimate;
    stats.relative_rmse_low = error.relative_rmse.low;
    stats.relative_rmse_high = error.relative_rmse.high;
    return stats;
}

std::vector<pt_function_accuracy> Renderer::accuracy() {
    return measured_accuracy(device_);
}

} // namespace pt
