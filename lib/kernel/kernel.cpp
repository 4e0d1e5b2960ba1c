#include "lib/kernel/kernel.h"

#include "lib/base/error.h"
#include "lib/film/sample_set.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace pt {

namespace {

std::uint64_t checked_scene_bytes(const vulkan::Device &device, std::size_t words) {
    const std::uint64_t bytes = std::max<std::uint64_t>(words, gpu::UNIFORM_SCENE_WORDS) * sizeof(glm::vec4);
    const std::uint64_t limit = device.limits().max_storage_buffer_range;
    if (bytes > limit)
        throw Error(PT_ERROR_UNSUPPORTED, "the scene takes " + std::to_string(bytes) +
                                              " bytes, more than this device can bind (" + std::to_string(limit) + ")");
    return bytes;
}

std::uint32_t samples_of_dispatch(const vulkan::Device &device, const Features &features, const PointLayout &layout,
                                  std::uint32_t table_bytes) {
    const std::uint64_t trips = loop_trips_per_sample(features);
    const std::uint64_t budget = device.limits().loop_trip_budget;
    if (trips > budget)
        refuse_argument("render", "max_path_length", std::to_string(features[gpu::ID_MAX_PATH_LENGTH]),
                        "a sample of this scene takes up to " + std::to_string(trips) +
                            " loop trips, and this driver stops a kernel after " + std::to_string(budget) +
                            ": use shorter paths or fewer surfaces",
                        PT_ERROR_UNSUPPORTED);
    const std::uint64_t rows =
        layout.row_blocks() > 0 ? table_bytes / sizeof(PointBlock) / layout.row_blocks() : gpu::FILM_MAX_GATHERED;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>({budget / trips, rows, gpu::FILM_MAX_GATHERED}));
}

} // namespace

Kernel::Kernel(vulkan::Device &device, TracePipelines &pipelines, DeviceFilm &film, const vulkan::Buffer *tree,
               std::shared_ptr<const View> view, const RenderSettings &settings) :
    device_(device),
    pipelines_(pipelines),
    film_(film),
    view_(std::move(view)),
    layout_(pt::point_layout(features())),
    table_bytes_(device.limits().max_uniform_range),
    max_dispatch_samples_(samples_of_dispatch(device, features(), layout_, table_bytes_)),
    overlap_(device.policy().invocations > 0),
    scene_(device, vulkan::BufferUse::UniformOrStorage, checked_scene_bytes(device, view_->words.size()), "scene"),
    tree_(tree),
    points_(device, vulkan::BufferUse::Streamed,
            std::uint64_t{table_bytes_} * (layout_.row_blocks() > 0 ? max_tables * device.policy().queue_depth : 1),
            "points of a slice"),
    tile_lists_(device, film.grid()) {
    show(view_, settings);
}

void Kernel::bind_film(const vulkan::ComputePipeline &trace) {
    if (!sets_.empty())
        return;
    std::vector<vulkan::DescriptorSet> sets; // sets_ stays empty after a failure
    for (const DeviceFilm::Strip &strip : film_.strips()) {
        std::vector<vulkan::BufferRange> ranges = scene_ranges(*view_, scene_, tree_);
        ranges.insert(ranges.end(), {strip.words, points_, tile_lists_.buffer()});
        sets.push_back(trace.bind(ranges));
    }
    sets_ = std::move(sets);
}

bool Kernel::can_show(const View &view) const {
    return view.features == features() && view.words.size() == view_->words.size() && view.tree == view_->tree;
}

void Kernel::show(std::shared_ptr<const View> view, const RenderSettings &settings) {
    view_ = std::move(view);
    seed_ = settings.seed;
    frame_ = view_->frame;
    frame_.film_first_pixel = settings.first_row * settings.width;
    scene_is_old_ = true;
    seconds_ = 0.0;
}

void Kernel::build(TracePipelines &pipelines) const {
    pipelines.trace(features(), view_->words, seconds_);
    pipelines.fold();
}

void Kernel::dispatch_nothing() {
    const std::array pipelines = {&pipelines_.trace(features(), view_->words, seconds_), &pipelines_.fold()};
    bind_film(*pipelines.front());
    device_.submit([&](const vk::raii::CommandBuffer &commands) {
        for (const vulkan::ComputePipeline *pipeline : pipelines)
            pipeline->dispatch(commands, sets_.front(), std::as_bytes(std::span(&frame_, 1)), 0, {{0}});
    });
}

// Each batch is one dispatch into one part of the film. The next table of points is free, because slices end in order
// and each running slice has tables of its own.
std::vector<Kernel::Batch> Kernel::next_batches(const TileSlice &slice) {
    const std::uint64_t split = slice.split();
    SampleRange before = slice.before;
    std::vector<Batch> batches;
    for (std::uint64_t sample = slice.samples.first; sample < slice.samples.end; sample = batches.back().range().end) {
        const bool is_older = sample < split;
        const std::uint64_t end_in_part = is_older ? std::min(split, slice.samples.end) : slice.samples.end;
        const std::uint64_t count = std::min<std::uint64_t>(max_dispatch_samples_, end_in_part - sample);
        batches.push_back({static_cast<std::uint32_t>(sample), static_cast<std::uint32_t>(count),
                           next_table_ * table_bytes_, is_older ? older_part : newer_part,
                           begins_part(before, split, sample)});
        next_table_ = (next_table_ + 1) % static_cast<std::uint32_t>(points_.size() / table_bytes_);
        before = hull_of(before, batches.back().range());
    }
    return batches;
}

void Kernel::upload_points(const std::vector<Batch> &batches) {
    if (layout_.row_blocks() == 0)
        return;
    for (const Batch &batch : batches) {
        std::vector<std::uint32_t> indices(batch.sample_count);
        std::iota(indices.begin(), indices.end(), batch.first_sample);
        const std::vector<PointBlock> table = point_table(features()[gpu::ID_SAMPLER], seed_, indices, layout_);
        points_.upload(std::as_bytes(std::span(table)), batch.table_offset);
    }
}

// Several invocations take samples of one pixel, so that few tiles keep the device busy.
std::uint32_t Kernel::sharers_of(std::size_t tile_count, std::uint32_t sample_count) const {
    constexpr std::uint32_t least_samples = 4;
    const std::size_t wanted = device_.policy().invocations / (tile_count * gpu::WORKGROUP_SIZE);
    return static_cast<std::uint32_t>(std::clamp<std::size_t>(wanted, 1, std::max(sample_count / least_samples, 1U)));
}

void Kernel::dispatch(const vk::raii::CommandBuffer &commands, const vulkan::ComputePipeline &pipeline,
                      std::span<const std::uint32_t> tiles, gpu::FrameConstants frame,
                      std::uint32_t table_offset) const {
    const TileGrid grid = film_.grid();
    const std::uint32_t first_entry = frame.first_entry;
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        const DeviceFilm::Strip &strip = film_.strips()[i];
        const std::uint32_t first_row = strip.first_pixel / grid.width;
        const std::uint32_t last_row = (strip.first_pixel + (strip.pixel_count - 1)) / grid.width;
        const auto first_with_row = [&](std::uint32_t row) {
            const auto lies_above = [&](std::uint32_t tile) { return tile / grid.columns() < row / gpu::TILE_SIZE; };
            return static_cast<std::uint32_t>(std::ranges::partition_point(tiles, lies_above) - tiles.begin());
        };
        const std::uint32_t end = first_with_row(last_row + gpu::TILE_SIZE);
        frame.strip_first_pixel = strip.first_pixel;
        frame.strip_pixel_count = strip.pixel_count;
        const std::uint32_t most = device_.limits().max_workgroup_count;
        std::uint32_t count = 0;
        for (std::uint32_t first = first_with_row(first_row); first < end; first += count) {
            count = std::min(end - first, most);
            frame.first_entry = first_entry + first;
            const std::uint32_t sharers = (frame.sample_count + frame.share - 1) / frame.share;
            pipeline.dispatch(commands, sets_[i], std::as_bytes(std::span(&frame, 1)), count, {{table_offset}},
                              sharers);
        }
    }
}

void Kernel::upload_scene() {
    if (scene_is_old_)
        scene_.upload(std::as_bytes(std::span(view_->words)), 0);
    scene_is_old_ = false;
}

BoundScene Kernel::bound_scene() {
    upload_scene();
    return {*view_, scene_ranges(*view_, scene_, tree_)};
}

vulkan::Device::Ticket Kernel::start(const TileSlice &slice, bool on_cleared_film, const Behind &behind) {
    const std::vector<Batch> batches = slice.takes ? next_batches(slice) : std::vector<Batch>();
    upload_points(batches);
    if (view_->words.size() * sizeof(glm::vec4) > vulkan::max_recorded_bytes)
        upload_scene();
    const vulkan::ComputePipeline &fold = pipelines_.fold();
    bind_film(fold);
    const vulkan::ComputePipeline *const trace =
        batches.empty() ? nullptr : &pipelines_.trace(features(), view_->words, seconds_);
    gpu::FrameConstants frame = frame_;
    frame.first_entry = tile_lists_.first_entry(slice.tiles);
    const FilmPart kept = split_of(slice.before) < slice.split() ? older_part : newer_part;
    const bool refills = std::ranges::any_of(batches, &Batch::begins_part);
    const vulkan::Device::Ticket ticket = device_.start([&](const vk::raii::CommandBuffer &commands) {
        if (scene_is_old_)
            scene_.write(commands, std::as_bytes(std::span(view_->words)));
        if (on_cleared_film)
            film_.clear(commands);
        if (scene_is_old_ || on_cleared_film)
            vulkan::barrier_between_commands(commands);
        if (slice.moves_split()) {
            frame.film_part = kept;
            frame.is_first = overwrites(refills);
            frame.sample_count = frame.share = 1;
            dispatch(commands, fold, slice.tiles, frame, 0);
            vulkan::barrier_between_commands(commands);
        }
        for (const Batch &batch : batches) {
            if (&batch != &batches.front() && !overlap_)
                vulkan::barrier_between_commands(commands);
            frame.film_part = batch.part;
            frame.is_first = overwrites(batch.begins_part);
            frame.first_sample = batch.first_sample;
            frame.sample_count = batch.sample_count;
            const std::uint32_t sharers = sharers_of(slice.tiles.size(), batch.sample_count);
            frame.share = (batch.sample_count + sharers - 1) / sharers;
            dispatch(commands, *trace, slice.tiles, frame, batch.table_offset);
        }
        if (behind) {
            vulkan::barrier_between_commands(commands);
            behind(commands);
        }
    });
    scene_is_old_ = false;
    return ticket;
}

double Kernel::finish(vulkan::Device::Ticket ticket, double expected_seconds) {
    const double seconds = device_.finish(ticket, expected_seconds);
    seconds_ += seconds;
    return seconds;
}

} // namespace pt
