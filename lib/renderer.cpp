// The renderer's loop; see renderer.h.
#include "renderer.h"

#include "accuracy.h"
#include "commit.spv.h"
#include "error.h"
#include "gpu_scene.h"
#include "pathtrace.spv.h"
#include "point_sequence.h"
#include "sample_halves.h"
#include "vulkan/device_choice.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace pt {

namespace {

constexpr std::array kernel_bindings = {vk::DescriptorType::eUniformBuffer, vk::DescriptorType::eStorageBuffer,
                                        vk::DescriptorType::eStorageBuffer, vk::DescriptorType::eStorageBuffer,
                                        vk::DescriptorType::eStorageBuffer};

// Rows of the point table, which bounds the samples of a slice: 4 MiB at the most.
constexpr std::uint32_t max_table_rows = 4096;
// The kernel reads blocks of four coordinates, of which a row's last may be beyond it.
constexpr std::uint32_t table_padding = 3;

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

void Renderer::prepare_pipelines(const Features &features) {
    if (!commit_pipeline_)
        commit_pipeline_.emplace(device_, commit_spirv, kernel_bindings, sizeof(gpu::FrameConstants),
                                 std::span<const std::uint32_t>{});
    if (traced_features_ == features)
        return;
    traced_features_.reset(); // of no pipeline, if this one cannot be built
    trace_pipeline_.emplace(device_, pathtrace_spirv, kernel_bindings, sizeof(gpu::FrameConstants),
                            specialization_constants(features));
    traced_features_ = features;
}

void Renderer::prepare_kernel() {
    if (kernel_)
        return;
    const Features features = features_of(*scene_, *camera_, *settings_);
    const std::vector<glm::vec4> words = gpu_scene(*scene_, *camera_, features);
    const std::uint64_t scene_bytes =
        std::max<std::uint64_t>(words.size(), gpu::UNIFORM_SCENE_WORDS) * sizeof(glm::vec4);
    const vulkan::Limits &limits = device_.limits();
    if (scene_bytes > limits.max_storage_buffer_range)
        throw Error(PT_ERROR_UNSUPPORTED, "the scene takes " + std::to_string(scene_bytes) +
                                              " bytes, more than this device can bind (" +
                                              std::to_string(limits.max_storage_buffer_range) + ")");
    const std::uint64_t trips = loop_trips_per_sample(features);
    if (trips > limits.loop_trip_budget)
        throw Error(PT_ERROR_UNSUPPORTED, "a sample of this scene takes up to " + std::to_string(trips) +
                                              " loop trips, and this driver stops a kernel after " +
                                              std::to_string(limits.loop_trip_budget) +
                                              ": fewer surfaces or a smaller max_path_length would do");

    const std::uint64_t table_bytes =
        (std::uint64_t{max_table_rows} * point_layout(features).row_words() + table_padding + 1) *
        sizeof(std::uint32_t);

    prepare_pipelines(features);
    const double unit = film_unit(*scene_);
    ScheduleLimits schedule_limits{};
    schedule_limits.target_seconds = target_seconds_;
    schedule_limits.first_slice_paths =
        target_seconds_ * assumed_tests_per_second / static_cast<double>(surface_tests_per_path(features));
    // An invocation takes the samples of one half.
    const auto max_samples_of_half =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(limits.loop_trip_budget / trips, max_table_rows));
    schedule_limits.max_samples = std::min(longest_range(max_samples_of_half), max_table_rows);
    schedule_limits.pixel_granularity = gpu::WORKGROUP_SIZE;

    Kernel kernel{features,
                  unit,
                  frame_constants(*camera_, *settings_, unit),
                  vulkan::Buffer(device_, vulkan::BufferUse::UniformOrStorage, scene_bytes, "scene"),
                  vulkan::Buffer(device_, vulkan::BufferUse::Storage, table_bytes, "points of a slice"),
                  {},
                  {},
                  Schedule(film_->pixel_count(), schedule_limits)};
    kernel.scene.upload(std::as_bytes(std::span(words)), 0);
    for (Film::Strip &strip : film_->strips()) {
        const std::array buffers = {&kernel.scene, &kernel.scene, &strip.words, &strip.pass, &kernel.points};
        kernel.trace_sets.push_back(trace_pipeline_->bind(buffers));
        kernel.commit_sets.push_back(commit_pipeline_->bind(buffers));
    }
    kernel_ = std::move(kernel);
}

// Submits a slice, and with the last slice of a split pass the addition of its samples to the film.
double Renderer::run(const Slice &slice) {
    const std::uint32_t slice_end = slice.first_pixel + slice.pixel_count;
    const bool pass_complete = !slice.whole && slice_end == film_->pixel_count();
    const std::uint32_t first_sample = settings_->first_sample + samples_done_;
    gpu::FrameConstants frame = kernel_->frame;
    frame.split_pass = slice.whole ? 0 : 1;

    // Each half's samples are rows of their own in the table of points.
    const SampleHalves sample_halves(settings_->sampler);
    std::array<HalfRange, gpu::FILM_HALVES> halves{};
    std::vector<std::uint32_t> indices;
    for (std::uint32_t half = 0; half < gpu::FILM_HALVES; ++half) {
        halves[half] = sample_halves.range(half, first_sample, slice.sample_count);
        std::ranges::copy(sample_halves.indices(half, halves[half]), std::back_inserter(indices));
    }
    if (const PointLayout layout = point_layout(kernel_->features); layout.dimensions > 0) {
        const std::vector<std::uint32_t> points = point_table(settings_->sampler, indices, layout);
        kernel_->points.upload(std::as_bytes(std::span(points)), 0);
    }

    // Dispatches a kernel over the part of [first, end) in each strip, for each half that has samples.
    const auto dispatch = [&](const vk::raii::CommandBuffer &commands, const vulkan::ComputePipeline &pipeline,
                              const std::vector<vulkan::DescriptorSet> &sets, std::uint32_t first, std::uint32_t end) {
        for (std::size_t i = 0; i < sets.size(); ++i) {
            const Film::Strip &strip = film_->strips()[i];
            const std::uint32_t strip_first = std::max(first, strip.first_pixel);
            const std::uint32_t strip_end = std::min(end, strip.first_pixel + strip.pixel_count);
            if (strip_first >= strip_end)
                continue;
            frame.strip_first_pixel = strip.first_pixel;
            frame.strip_pixel_count = strip.pixel_count;
            frame.first_pixel = strip_first - strip.first_pixel;
            frame.pixel_count = strip_end - strip_first;
            const std::uint32_t groups = (frame.pixel_count + gpu::WORKGROUP_SIZE - 1) / gpu::WORKGROUP_SIZE;
            frame.first_row = 0;
            for (std::uint32_t half = 0; half < gpu::FILM_HALVES; ++half) {
                frame.film_half = half;
                frame.first_pair = halves[half].first_pair;
                frame.sample_count = halves[half].sample_count;
                if (frame.sample_count > 0)
                    pipeline.dispatch(commands, sets[i], std::as_bytes(std::span(&frame, 1)), groups);
                frame.first_row += frame.sample_count;
            }
        }
    };
    const double seconds = device_.submit([&](const vk::raii::CommandBuffer &commands) {
        dispatch(commands, *trace_pipeline_, kernel_->trace_sets, slice.first_pixel, slice_end);
        if (pass_complete) {
            vulkan::barrier_between_dispatches(commands);
            dispatch(commands, *commit_pipeline_, kernel_->commit_sets, 0, film_->pixel_count());
        }
    });
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
        film_->read(kernel_->film_unit, half_counts(),
                    [&](const PixelEstimates &pixels) { estimator.add(pixels.radiance, pixels.standard_error); });
        error_ =
            estimator.result(accuracy_of_halves(settings_->sampler, point_layout(kernel_->features), samples_done_));
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
        const Slice slice = kernel_->schedule.next(end - samples_done_, pass_pixels_done_);
        kernel_->schedule.measured(slice, run(slice));
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
    film_->read(kernel_->film_unit, half_counts(), [&](const PixelEstimates &pixels) {
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
    stats.features = kernel_ ? feature_bits(kernel_->features) : 0;
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
