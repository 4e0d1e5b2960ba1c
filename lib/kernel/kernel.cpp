// Specialisation, points and dispatches of the path-tracing kernel; see kernel.h.
#include "lib/kernel/kernel.h"

#include "lib/base/error.h"
#include "lib/film/sample_parts.h"
#include "lib/kernel/gpu_scene.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace pt {

namespace {

// Tables of points for one slice, 4 MiB at the most: one for each dispatch. A slice of 48 dispatches of 1023 samples
// is cut at no more than 13 powers of two, the first of them 8.
constexpr std::uint32_t max_tables = 64;
constexpr std::uint32_t max_full_dispatches = 48;

std::uint64_t checked_scene_bytes(const vulkan::Device &device, std::size_t words) {
    const std::uint64_t bytes = std::max<std::uint64_t>(words, gpu::UNIFORM_SCENE_WORDS) * sizeof(glm::vec4);
    const std::uint64_t limit = device.limits().max_storage_buffer_range;
    if (bytes > limit)
        throw Error(PT_ERROR_UNSUPPORTED, "the scene takes " + std::to_string(bytes) +
                                              " bytes, more than this device can bind (" + std::to_string(limit) + ")");
    return bytes;
}

// Samples that a dispatch may take in a pixel: some drivers bound its loop trips, and its points must fit into a table.
std::uint32_t samples_of_dispatch(const vulkan::Device &device, const Features &features, const PointLayout &layout,
                                  std::uint32_t table_bytes) {
    const std::uint64_t trips = loop_trips_per_sample(features);
    const std::uint64_t budget = device.limits().loop_trip_budget;
    if (trips > budget)
        throw Error(PT_ERROR_UNSUPPORTED, "a sample of this scene takes up to " + std::to_string(trips) +
                                              " loop trips, and this driver stops a kernel after " +
                                              std::to_string(budget) +
                                              ": fewer surfaces or a smaller max_path_length would do");
    const std::uint64_t rows =
        layout.row_blocks() > 0 ? table_bytes / sizeof(PointBlock) / layout.row_blocks() : gpu::FILM_MAX_GATHERED;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>({budget / trips, rows, gpu::FILM_MAX_GATHERED}));
}

// Invocations that share a pixel's samples, so that a small image keeps the device busy.
std::uint32_t sharers_of_pixel(const vulkan::Device &device, std::uint32_t pixel_count) {
    constexpr std::uint32_t most = 8; // each adds to the film, and needs some samples to make that worth it
    return std::clamp(device.policy().invocations / pixel_count, 1U, most);
}

} // namespace

Kernel::Kernel(vulkan::Device &device, TracePipelines &pipelines, Film &film, const Scene &scene, const Camera &camera,
               const RenderSettings &settings) :
    device_(device),
    pipelines_(pipelines),
    film_(film),
    features_(features_of(scene, camera, settings)),
    layout_(pt::point_layout(features_)),
    sampler_(settings.sampler),
    seed_(settings.seed),
    first_index_(settings.first_sample),
    first_pixel_(settings.first_row * settings.width),
    film_unit_(pt::film_unit(scene)),
    frame_(frame_constants(camera, settings, film_unit_)),
    table_bytes_(device.limits().max_uniform_range),
    sharers_(sharers_of_pixel(device, film.pixel_count())),
    max_dispatch_samples_(samples_of_dispatch(device, features_, layout_, table_bytes_)),
    overlap_(device.policy().invocations > 0),
    words_(gpu_scene(scene, camera, features_)),
    scene_(device, vulkan::BufferUse::UniformOrStorage, checked_scene_bytes(device, words_.size()), "scene"),
    points_(device, vulkan::BufferUse::Streamed,
            std::uint64_t{table_bytes_} * (layout_.row_blocks() > 0 ? max_tables * device.policy().queue_depth : 1),
            "points of a slice") {
    scene_.upload(std::as_bytes(std::span(words_)), 0);
    const vulkan::ComputePipeline &trace = pipelines_.trace(features_, sharers_, words_, seconds_);
    for (Film::Strip &strip : film_.strips()) {
        const std::array buffers = {&scene_, &scene_, &strip.words, &strip.pass, &points_};
        sets_.push_back(trace.bind(buffers));
    }
}

void Kernel::build(TracePipelines &pipelines) const {
    pipelines.trace(features_, sharers_, words_, seconds_);
    pipelines.commit();
    pipelines.fold();
}

std::uint32_t Kernel::max_samples() const {
    return max_dispatch_samples_ * max_full_dispatches;
}

// The samples of a slice as batches of one dispatch each, all of one part of the film. Their tables are free: slices
// end in the order in which they were started, and there is room for all that are under way.
std::vector<Kernel::Batch> Kernel::next_batches(std::uint32_t first_sample, std::uint32_t sample_count) {
    std::vector<Batch> batches;
    const std::uint32_t end = first_sample + sample_count;
    for (std::uint32_t sample = first_sample; sample < end; sample += batches.back().sample_count) {
        const std::uint32_t of_part = std::min(end, end_of_part(sample)) - sample;
        batches.push_back({sample, std::min(max_dispatch_samples_, of_part), next_table_ * table_bytes_});
        next_table_ = (next_table_ + 1) % static_cast<std::uint32_t>(points_.size() / table_bytes_);
    }
    return batches;
}

void Kernel::upload_points(const std::vector<Batch> &batches) {
    if (layout_.row_blocks() == 0)
        return;
    for (const Batch &batch : batches) {
        std::vector<std::uint32_t> indices(batch.sample_count);
        std::iota(indices.begin(), indices.end(), first_index_ + batch.first_sample);
        const std::vector<PointBlock> table = point_table(sampler_, seed_, indices, layout_);
        points_.upload(std::as_bytes(std::span(table)), batch.table_offset);
    }
}

// Records a kernel over the part of a range of pixels that lies in each strip.
void Kernel::dispatch(const vk::raii::CommandBuffer &commands, const vulkan::ComputePipeline &pipeline,
                      const Slice &slice, const Batch &batch, std::uint32_t invocations_per_pixel) const {
    gpu::FrameConstants frame = frame_;
    frame.split_pass = slice.whole ? 0 : 1;
    frame.film_part = part_of(batch.first_sample);
    frame.first_sample = first_index_ + batch.first_sample;
    frame.sample_count = batch.sample_count;
    const std::uint32_t slice_end = slice.first_pixel + slice.pixel_count;
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        const Film::Strip &strip = film_.strips()[i];
        const std::uint32_t first = std::max(slice.first_pixel, strip.first_pixel);
        const std::uint32_t end = std::min(slice_end, strip.first_pixel + strip.pixel_count);
        if (first >= end)
            continue;
        frame.strip_first_pixel = first_pixel_ + strip.first_pixel;
        frame.strip_pixel_count = strip.pixel_count;
        frame.first_pixel = first - strip.first_pixel;
        frame.pixel_count = end - first;
        const std::uint32_t groups = (frame.pixel_count + gpu::WORKGROUP_SIZE - 1) / gpu::WORKGROUP_SIZE;
        pipeline.dispatch(commands, sets_[i], std::as_bytes(std::span(&frame, 1)), groups, {{batch.table_offset}},
                          invocations_per_pixel);
    }
}

// Each batch of whole samples finds the film's older part complete: where it is not, the newer one is folded into it
// first.
vulkan::Device::Ticket Kernel::start(const Slice &slice, std::uint32_t first_sample) {
    const Slice all_pixels{0, film_.pixel_count(), 1, true};
    std::uint32_t older_end = film_.older_end();
    const std::vector<Batch> batches = next_batches(first_sample, slice.sample_count);
    upload_points(batches);
    if (!slice.whole)
        build_commit(first_sample);
    const vulkan::ComputePipeline &trace = pipelines_.trace(features_, sharers_, words_, seconds_);
    const vulkan::Device::Ticket ticket = device_.start([&](const vk::raii::CommandBuffer &commands) {
        for (const Batch &batch : batches) {
            const bool is_first = &batch == &batches.front();
            const std::uint32_t needed = part_counts(batch.first_sample + 1)[0];
            const bool folds = slice.whole && needed > older_end;
            if (!is_first && (folds || !overlap_))
                vulkan::barrier_between_dispatches(commands);
            if (folds) {
                dispatch(commands, pipelines_.fold(), all_pixels, batch, 1);
                vulkan::barrier_between_dispatches(commands);
                older_end = needed;
            }
            dispatch(commands, trace, slice, batch, sharers_);
        }
    });
    film_.set_older_end(older_end);
    return ticket;
}

// Folds range by range too: only where the pass has been added to all pixels is the film read.
vulkan::Device::Ticket Kernel::commit(const Slice &range, std::uint32_t sample) {
    const Batch batch{sample, 1, 0};
    const std::uint32_t needed = part_counts(sample + 1)[0];
    const vulkan::Device::Ticket ticket = device_.start([&](const vk::raii::CommandBuffer &commands) {
        if (needed > film_.older_end()) {
            dispatch(commands, pipelines_.fold(), range, batch, 1);
            vulkan::barrier_between_dispatches(commands);
        }
        dispatch(commands, pipelines_.commit(), range, batch, 1);
    });
    if (range.first_pixel + range.pixel_count == film_.pixel_count())
        film_.set_older_end(std::max(needed, film_.older_end()));
    return ticket;
}

// Before the pass, so that adding it cannot fail for want of them.
void Kernel::build_commit(std::uint32_t sample) {
    pipelines_.commit();
    if (part_counts(sample + 1)[0] > film_.older_end())
        pipelines_.fold();
}

double Kernel::finish(vulkan::Device::Ticket ticket) {
    const double seconds = device_.finish(ticket);
    seconds_ += seconds;
    return seconds;
}

} // namespace pt
