// Specialisation, points and dispatches of the path-tracing kernel; see kernel.h.
#include "kernel.h"

#include "error.h"
#include "gpu_scene.h"
#include "sample_halves.h"

#include <algorithm>
#include <string>

namespace pt {

namespace {

// Tables of points for one slice: 4 MiB at the most.
constexpr std::uint32_t max_tables = 64;

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
    first_pixel_(settings.first_row * settings.width),
    film_unit_(pt::film_unit(scene)),
    frame_(frame_constants(camera, settings, film_unit_)),
    table_bytes_(device.limits().max_uniform_range),
    sharers_(sharers_of_pixel(device, film.pixel_count())),
    max_dispatch_samples_(samples_of_dispatch(device, features_, layout_, table_bytes_)),
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

std::uint32_t Kernel::max_samples() const {
    return longest_range(max_dispatch_samples_ * (max_tables / gpu::FILM_HALVES));
}

// The samples of a slice as rounds, each of at most one dispatch for each half: those of a round may run at the same
// time. Their tables are free: slices end in the order in which they were started, and there is room for all that are
// under way.
std::vector<std::vector<Kernel::Batch>> Kernel::next_rounds(std::uint32_t first_sample, std::uint32_t sample_count) {
    std::vector<std::vector<Batch>> rounds;
    for (std::uint32_t half = 0; half < gpu::FILM_HALVES; ++half) {
        const HalfRange range = SampleHalves(sampler_).range(half, first_sample, sample_count);
        for (std::uint32_t done = 0; done < range.sample_count; done += max_dispatch_samples_) {
            const std::size_t round = done / max_dispatch_samples_;
            rounds.resize(std::max(rounds.size(), round + 1));
            const std::uint32_t count = std::min(max_dispatch_samples_, range.sample_count - done);
            rounds[round].push_back({half, range.first_pair + done, count, next_table_ * table_bytes_});
            next_table_ = (next_table_ + 1) % static_cast<std::uint32_t>(points_.size() / table_bytes_);
        }
    }
    return rounds;
}

void Kernel::upload_points(const std::vector<std::vector<Batch>> &rounds) {
    if (layout_.row_blocks() == 0)
        return;
    for (const std::vector<Batch> &round : rounds) {
        for (const Batch &batch : round) {
            const std::vector<std::uint32_t> indices =
                SampleHalves(sampler_).indices(batch.half, {batch.first_pair, batch.sample_count});
            const std::vector<PointBlock> table = point_table(sampler_, seed_, indices, layout_);
            points_.upload(std::as_bytes(std::span(table)), batch.table_offset);
        }
    }
}

// Records a kernel over the part of a range of pixels that lies in each strip.
void Kernel::dispatch(const vk::raii::CommandBuffer &commands, const vulkan::ComputePipeline &pipeline,
                      const Slice &slice, const Batch &batch, std::uint32_t invocations_per_pixel) const {
    gpu::FrameConstants frame = frame_;
    frame.split_pass = slice.whole ? 0 : 1;
    frame.film_half = batch.half;
    frame.first_pair = batch.first_pair;
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

vulkan::Device::Ticket Kernel::start(const Slice &slice, std::uint32_t first_sample) {
    const bool pass_complete = !slice.whole && slice.first_pixel + slice.pixel_count == film_.pixel_count();
    const std::vector<std::vector<Batch>> rounds = next_rounds(first_sample, slice.sample_count);
    upload_points(rounds);
    const vulkan::ComputePipeline &trace = pipelines_.trace(features_, sharers_, words_, seconds_);
    return device_.start([&](const vk::raii::CommandBuffer &commands) {
        for (std::size_t i = 0; i < rounds.size(); ++i) {
            if (i > 0)
                vulkan::barrier_between_dispatches(commands);
            for (const Batch &batch : rounds[i])
                dispatch(commands, trace, slice, batch, sharers_);
        }
        if (pass_complete) {
            const Slice whole_pass{0, film_.pixel_count(), 1, false};
            vulkan::barrier_between_dispatches(commands);
            dispatch(commands, pipelines_.commit(), whole_pass, rounds[0][0], 1); // a pass is one sample
        }
    });
}

double Kernel::finish(vulkan::Device::Ticket ticket) {
    const double seconds = device_.finish(ticket);
    seconds_ += seconds;
    return seconds;
}

} // namespace pt
