// Specialisation, points and dispatches of the path-tracing kernel; see kernel.h.
#include "lib/kernel/kernel.h"

#include "lib/base/error.h"
#include "lib/film/film_parts.h"
#include "lib/film/host_fold.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace pt {

namespace {

// Tables of points for one slice, 4 MiB at the most: one for each dispatch. The film's split cuts a slice once more.
constexpr std::uint32_t max_tables = 64;
constexpr std::uint32_t max_full_dispatches = max_tables - 1;

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
        throw Error(PT_ERROR_UNSUPPORTED,
                    BrokenRule{.subject = "render",
                               .member = "max_path_length",
                               .value = std::to_string(features.max_path_length),
                               .rule = "a sample of this scene takes up to " + std::to_string(trips) +
                                       " loop trips, and this driver stops a kernel after " + std::to_string(budget) +
                                       ": shorter paths or fewer surfaces would do"});
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

Kernel::Kernel(vulkan::Device &device, TracePipelines &pipelines, DeviceFilm &film, vulkan::Buffer *tree,
               std::shared_ptr<const GpuScene> scene, const RenderSettings &settings) :
    device_(device),
    pipelines_(pipelines),
    film_(film),
    gpu_scene_(std::move(scene)),
    features_(gpu_scene_->features),
    layout_(pt::point_layout(features_)),
    sampler_(settings.sampler),
    seed_(settings.seed),
    first_pixel_(settings.first_row * settings.width),
    frame_(gpu_scene_->frame),
    table_bytes_(device.limits().max_uniform_range),
    sharers_(sharers_of_pixel(device, film.pixel_count())),
    max_dispatch_samples_(samples_of_dispatch(device, features_, layout_, table_bytes_)),
    overlap_(device.policy().invocations > 0),
    scene_(device, vulkan::BufferUse::UniformOrStorage, checked_scene_bytes(device, gpu_scene_->words.size()), "scene"),
    tree_(tree),
    points_(device, vulkan::BufferUse::Streamed,
            std::uint64_t{table_bytes_} * (layout_.row_blocks() > 0 ? max_tables * device.policy().queue_depth : 1),
            "points of a slice") {}

// No kernel touches the pass before there is one.
void Kernel::bind_film(const vulkan::ComputePipeline &trace) {
    if (sets_.empty())
        for (const DeviceFilm::Strip &strip : film_.strips())
            sets_.push_back(bound(trace, strip, strip.words));
}

// What reads the tree is not in the kernel of a scene without one, but its bindings are.
vulkan::DescriptorSet Kernel::bound(const vulkan::ComputePipeline &trace, const DeviceFilm::Strip &strip,
                                    const vulkan::Buffer &pass) const {
    const vulkan::Buffer &tree = tree_ ? *tree_ : scene_;
    const std::uint64_t node_bytes = tree_ ? gpu_scene_->tree->node_words().size_bytes() : vulkan::texel_bytes;
    const std::uint64_t first_sphere = tree_ ? node_bytes : 0;
    const std::uint64_t sphere_bytes = tree_ ? gpu_scene_->tree->sphere_words().size_bytes() : vulkan::texel_bytes;
    const std::array ranges = {vulkan::BufferRange(scene_),
                               vulkan::BufferRange(scene_),
                               vulkan::BufferRange(strip.words),
                               vulkan::BufferRange(pass),
                               vulkan::BufferRange(points_),
                               vulkan::BufferRange(tree.handle(), 0, node_bytes),
                               vulkan::BufferRange(tree.handle(), first_sphere, sphere_bytes),
                               vulkan::BufferRange(tile_lists_ ? *tile_lists_ : scene_)};
    return trace.bind(ranges);
}

bool Kernel::can_show(const GpuScene &scene) const {
    return scene.features == features_ && scene.words.size() == gpu_scene_->words.size() &&
           scene.tree == gpu_scene_->tree;
}

void Kernel::show(std::shared_ptr<const GpuScene> scene, const RenderSettings &settings) {
    gpu_scene_ = std::move(scene);
    sampler_ = settings.sampler;
    seed_ = settings.seed;
    first_pixel_ = settings.first_row * settings.width;
    frame_ = gpu_scene_->frame;
    scene_is_old_ = true;
    seconds_ = 0.0;
}

void Kernel::build(TracePipelines &pipelines, bool by_tile) const {
    pipelines.trace(features_, sharers_, gpu_scene_->words, seconds_);
    pipelines.commit();
    pipelines.fold();
    if (by_tile) {
        pipelines.trace(features_, TracePipelines::of_tile_list, gpu_scene_->words, seconds_);
        pipelines.fold_tiles();
    }
}

void Kernel::dispatch_nothing() {
    const std::array pipelines = {&pipelines_.trace(features_, sharers_, gpu_scene_->words, seconds_),
                                  &pipelines_.commit(), &pipelines_.fold()};
    bind_film(*pipelines.front());
    device_.submit([&](const vk::raii::CommandBuffer &commands) {
        for (const vulkan::ComputePipeline *pipeline : pipelines)
            pipeline->dispatch(commands, sets_.front(), std::as_bytes(std::span(&frame_, 1)), 0, {{0}});
    });
}

std::uint32_t Kernel::max_samples() const {
    return max_dispatch_samples_ * max_full_dispatches;
}

// The samples of a slice as batches of one dispatch each, all of one part of the film as the slice leaves it: the split
// moves once at the most, before them. Their tables are free: slices end in the order in which they were started, and
// there is room for all that are under way.
std::vector<Kernel::Batch> Kernel::next_batches(const SampleRange &samples, std::uint64_t split, SampleRange before) {
    std::vector<Batch> batches;
    for (std::uint64_t sample = samples.first; sample < samples.end; sample = batches.back().range().end) {
        const std::uint64_t end_in_part = sample < split ? std::min(split, samples.end) : samples.end;
        const std::uint64_t count = std::min<std::uint64_t>(max_dispatch_samples_, end_in_part - sample);
        batches.push_back(next_batch({sample, sample + count}));
        batches.back().begins_part = begins_part(before, split, sample);
        before = hull_of(before, batches.back().range());
    }
    return batches;
}

Kernel::Batch Kernel::next_batch(const SampleRange &samples) {
    const Batch batch{static_cast<std::uint32_t>(samples.first), static_cast<std::uint32_t>(samples.count()),
                      next_table_ * table_bytes_, false};
    next_table_ = (next_table_ + 1) % static_cast<std::uint32_t>(points_.size() / table_bytes_);
    return batch;
}

void Kernel::upload_points(const std::vector<Batch> &batches) {
    if (layout_.row_blocks() == 0)
        return;
    for (const Batch &batch : batches) {
        std::vector<std::uint32_t> indices(batch.sample_count);
        std::iota(indices.begin(), indices.end(), batch.first_sample);
        const std::vector<PointBlock> table = point_table(sampler_, seed_, indices, layout_);
        points_.upload(std::as_bytes(std::span(table)), batch.table_offset);
    }
}

// Whether a dispatch need not read what it adds to. Those that overlap add by atomic operations.
std::uint32_t Kernel::overwrites(const FilmTarget &target) const {
    return target.is_empty && !overlap_ ? 1 : 0;
}

// Where nothing is under way that may read the film, slices or an image for a caller who does not wait for it, and what
// is emptied will be overwritten.
bool Kernel::folds_on_host() const {
    return !overlap_ && film_.is_host_memory() && device_.is_at_rest();
}

// Records a kernel over the part of a range of pixels that lies in each strip.
void Kernel::dispatch(const vk::raii::CommandBuffer &commands, const vulkan::ComputePipeline &pipeline,
                      const Slice &slice, const Batch &batch, const FilmTarget &target,
                      std::uint32_t invocations_per_pixel) const {
    gpu::FrameConstants frame = frame_;
    frame.split_pass = slice.whole ? 0 : 1;
    frame.film_part = target.part;
    frame.is_first = overwrites(target);
    frame.first_sample = batch.first_sample;
    frame.sample_count = batch.sample_count;
    const std::uint32_t slice_end = slice.first_pixel + slice.pixel_count;
    const std::vector<vulkan::DescriptorSet> &sets = pass_sets_.empty() ? sets_ : pass_sets_;
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const DeviceFilm::Strip &strip = film_.strips()[i];
        const std::uint32_t first = std::max(slice.first_pixel, strip.first_pixel);
        const std::uint32_t end = std::min(slice_end, strip.first_pixel + strip.pixel_count);
        if (first >= end)
            continue;
        frame.strip_first_pixel = first_pixel_ + strip.first_pixel;
        frame.strip_pixel_count = strip.pixel_count;
        frame.first_pixel = first - strip.first_pixel;
        frame.pixel_count = end - first;
        const std::uint32_t groups = (frame.pixel_count + gpu::WORKGROUP_SIZE - 1) / gpu::WORKGROUP_SIZE;
        pipeline.dispatch(commands, sets[i], std::as_bytes(std::span(&frame, 1)), groups, {{batch.table_offset}},
                          invocations_per_pixel);
    }
}

// A scene of usual size comes with the commands; for others there is a transfer of their own. Idle, or no change.
void Kernel::upload_scene() {
    if (scene_is_old_ && !scene_fits_commands()) {
        scene_.upload(std::as_bytes(std::span(gpu_scene_->words)), 0);
        scene_is_old_ = false;
    }
}

bool Kernel::scene_fits_commands() const {
    return gpu_scene_->words.size() * sizeof(glm::vec4) <= vulkan::max_recorded_bytes;
}

// Where the film's split moves, its parts are folded first.
vulkan::Device::Ticket Kernel::start(const Slice &slice, std::uint32_t first_sample, const SampleRange &hull,
                                     bool on_cleared_film, const Behind &behind) {
    const Slice all_pixels{0, film_.pixel_count(), 1, true};
    PartUse parts = on_cleared_film ? PartUse{} : film_.parts();
    const SampleRange samples{first_sample, std::uint64_t{first_sample} + slice.sample_count};
    const SampleRange extended = hull_of(hull, samples);
    const bool folds = slice.whole && parts.needs_fold(extended);
    const std::vector<Batch> batches = next_batches(samples, split_of(extended), parts.hull());
    if (slice.whole)
        parts.extend(extended);
    upload_points(batches);
    upload_scene();
    const bool makes_pass = !slice.whole && !film_.has_pass();
    if (!slice.whole)
        prepare_pass();
    const vulkan::ComputePipeline &trace = pipelines_.trace(features_, sharers_, gpu_scene_->words, seconds_);
    bind_film(trace);
    const bool refills = std::ranges::any_of(batches, &Batch::begins_part);
    HostFold host_fold(film_, 0);
    const bool is_folded = folds && refills && folds_on_host() && host_fold.fold({{0, film_.pixel_count()}});
    const vulkan::Device::Ticket ticket = device_.start([&](const vk::raii::CommandBuffer &commands) {
        if (scene_is_old_)
            scene_.write(commands, std::as_bytes(std::span(gpu_scene_->words)));
        if (on_cleared_film)
            film_.clear(commands, 0, film_.pixel_count());
        else if (makes_pass)
            film_.clear_pass(commands);
        if (scene_is_old_ || on_cleared_film || makes_pass)
            vulkan::barrier_between_commands(commands);
        if (folds && !is_folded) {
            dispatch(commands, pipelines_.fold(), all_pixels, batches.front(), {0, refills}, 1);
            vulkan::barrier_between_commands(commands);
        }
        for (const Batch &batch : batches) {
            if (&batch != &batches.front() && !overlap_)
                vulkan::barrier_between_commands(commands);
            dispatch(commands, trace, slice, batch, {parts.part_of(batch.first_sample), batch.begins_part}, sharers_);
        }
        if (behind) {
            vulkan::barrier_between_commands(commands);
            behind(commands, parts);
        }
    });
    host_fold.keep();
    scene_is_old_ = false;
    film_.set_parts(parts);
    return ticket;
}

vulkan::Device::Ticket Kernel::start_fold(const SampleRange &hull) {
    const Slice all_pixels{0, film_.pixel_count(), 1, true};
    bind_film(pipelines_.fold());
    PartUse parts = film_.parts();
    parts.extend(hull);
    const vulkan::Device::Ticket ticket = device_.start(
        [&](const vk::raii::CommandBuffer &commands) { dispatch(commands, pipelines_.fold(), all_pixels, {}, {}, 1); });
    film_.set_parts(parts);
    return ticket;
}

// Folds range by range too, which is safe because the film is read only after the pass has been added to all pixels.
vulkan::Device::Ticket Kernel::commit(const Slice &range, std::uint32_t sample, const SampleRange &hull) {
    const Batch batch{sample, 1, 0, false};
    const SampleRange extended = hull_of(hull, batch.range());
    PartUse parts = film_.parts();
    const bool folds = parts.needs_fold(extended);
    parts.extend(extended);
    const vulkan::Device::Ticket ticket = device_.start([&](const vk::raii::CommandBuffer &commands) {
        if (folds) {
            dispatch(commands, pipelines_.fold(), range, batch, {}, 1);
            vulkan::barrier_between_commands(commands);
        }
        dispatch(commands, pipelines_.commit(), range, batch, {parts.part_of(sample), false}, 1);
    });
    if (range.first_pixel + range.pixel_count == film_.pixel_count())
        film_.set_parts(parts);
    return ticket;
}

// All that the pass needs before it starts, so that adding it cannot fail for lack of something.
void Kernel::prepare_pass() {
    pipelines_.commit();
    pipelines_.fold();
    film_.make_pass(device_);
    if (!pass_sets_.empty())
        return;
    const vulkan::ComputePipeline &trace = pipelines_.trace(features_, sharers_, gpu_scene_->words, seconds_);
    std::vector<vulkan::DescriptorSet> sets;
    for (const DeviceFilm::Strip &strip : film_.strips())
        sets.push_back(bound(trace, strip, *strip.pass));
    pass_sets_ = std::move(sets);
}

double Kernel::finish(vulkan::Device::Ticket ticket, double expected_seconds) {
    const double seconds = device_.finish(ticket, expected_seconds);
    seconds_ += seconds;
    return seconds;
}

} // namespace pt
