#include "lib/render/render_device.h"

#include "lib/base/error.h"
#include "shaders/gpu_layout.h"

#include <algorithm>
#include <string>
#include <utility>

namespace pt {

namespace {

// A new kernel is assumed to have this fraction of the rate measured with another kernel.
constexpr double share_assumed_of_learnt = 0.125;

} // namespace

RenderDevice::RenderDevice(vulkan::Instance &instance, const vk::raii::PhysicalDevice &physical_device,
                           const vulkan::DevicePolicy &policy, const KernelCode &code, double target_seconds,
                           const vulkan::CallerVulkan *caller) :
    device_(instance, physical_device, policy, caller),
    code_(code),
    pipelines_(std::make_unique<TracePipelines>(device_, code)),
    target_seconds_(target_seconds),
    tests_per_second_(device_.policy().tests_per_second) {
    under_way_.reserve(device_.policy().queue_depth);
}

RenderDevice::~RenderDevice() {
    if (!device_.comes_to_rest())
        device_.abandon();
}

// The present film's memory counts as free, because set_film() frees it.
DeviceFilm RenderDevice::make_film(const RenderSettings &settings) {
    const std::uint64_t bytes =
        std::uint64_t{settings.width} * settings.row_count * DeviceFilm::bytes_per_pixel(settings.coverage);
    if (!device_.has_memory(bytes))
        throw Error(PT_ERROR_UNSUPPORTED,
                    BrokenRule{.subject = "render",
                               .member = "width",
                               .with = "* rows",
                               .value = std::to_string(settings.width) + " * " + std::to_string(settings.row_count),
                               .rule = "the film takes " + std::to_string(bytes) + " bytes, and the device has " +
                                       std::to_string(device_.info().memory_bytes) +
                                       ": render fewer rows at a time (render.first_row, render.row_count)"});
    return {device_, settings.width, settings.row_count, max_strip_pixels(device_.limits(), settings.coverage),
            settings.coverage};
}

void RenderDevice::set_film(DeviceFilm film) {
    drop_bound();
    film_ = std::move(film);
    discard_samples();
}

void RenderDevice::discard_samples() noexcept {
    film_is_void_ = true;
}

std::unique_ptr<TracePipelines> RenderDevice::make_pipelines(const KernelCode &code) {
    auto pipelines = std::make_unique<TracePipelines>(device_, code);
    if (kernel_)
        kernel_->build(*pipelines);
    return pipelines;
}

void RenderDevice::drop_kernel() noexcept {
    if (kernel_) {
        const double tests_per_path = surface_tests_per_path(kernel_->features(), kernel_->view().tree.get());
        const double learnt = schedule_->budget() * tests_per_path / target_seconds_;
        tests_per_second_ = std::max(tests_per_second_, learnt * share_assumed_of_learnt);
    }
    kernel_.reset();
}

void RenderDevice::drop_bound() noexcept {
    drop_kernel();
    resolve_to_host_.reset();
    resolve_to_buffer_.reset();
    error_reader_.reset();
}

void RenderDevice::set_pipelines(const KernelCode &code, std::unique_ptr<TracePipelines> pipelines) noexcept {
    drop_bound();
    first_hits_.reset();
    resolve_.reset();
    estimate_.reset();
    add_.reset();
    pipelines_ = std::move(pipelines);
    code_ = code;
    device_.pipeline_cache().set_key(pipelines_->take_kernel_key());
}

void RenderDevice::keep_kernels(const vulkan::KernelStore &store) {
    device_.pipeline_cache().use(store, pipelines_->take_kernel_key(), device_.log());
}

void RenderDevice::save_kernels() noexcept {
    if (!device_.hangs())
        device_.pipeline_cache().save(device_.log());
}

void RenderDevice::prepare(const std::shared_ptr<const View> &view, const RenderSettings &settings) {
    pipelines_->build_own(TracePipelines::OwnKernels::when_they_pay);
    if (kernel_ && &kernel_->view() == view.get())
        return;
    if (kernel_ && kernel_->can_show(*view)) {
        kernel_->show(view, settings);
        return;
    }
    drop_kernel();
    plant(view->tree);
    kernel_.emplace(device_, *pipelines_, *film_, tree_buffer_ ? &*tree_buffer_ : nullptr, view, settings);
    const double tests_per_path = surface_tests_per_path(kernel_->features(), view->tree.get());
    schedule_.emplace(ScheduleLimits{.target_seconds = target_seconds_,
                                     .first_slice_paths = target_seconds_ * tests_per_second_ / tests_per_path,
                                     .max_samples = kernel_->max_samples()});
}

void RenderDevice::plant(const std::shared_ptr<const SphereTree> &tree) {
    if (tree == tree_)
        return;
    tree_.reset();
    tree_buffer_.reset();
    if (tree) {
        const auto words = std::as_bytes(std::span(tree->words()));
        const std::size_t needed = std::max(tree->node_words().size(), tree->sphere_words().size());
        const std::uint64_t limit = device_.limits().max_texel_count;
        if (needed > limit)
            refuse_argument("scene", "sphere_count", std::to_string(tree->sphere_count()),
                            "the tree over these spheres takes " + std::to_string(needed) +
                                " texels, and this device can bind " + std::to_string(limit),
                            PT_ERROR_UNSUPPORTED);
        tree_buffer_.emplace(device_, vulkan::BufferUse::Texels, words.size(), "tree");
        tree_buffer_->upload(words, 0);
    }
    tree_ = tree;
}

void RenderDevice::prepare_ahead(const std::shared_ptr<const View> &view, const RenderSettings &settings) {
    prepare(view, settings);
    pipelines_->build_own(TracePipelines::OwnKernels::at_once);
    kernel_->build(*pipelines_);
    kernel_->dispatch_nothing();
    if (device_.policy().resolve_on_device) {
        resolve_pipelines().of(PT_FORMAT_RGB32F);
        estimate_pipeline();
    }
}

void RenderDevice::prepare_for_polls(bool with_errors) {
    kernel_->build(*pipelines_);
    if (with_errors && device_.policy().resolve_on_device)
        estimate_pipeline();
    pipelines_->build_own(TracePipelines::OwnKernels::never);
}

DeviceFilm &RenderDevice::film() {
    if (film_is_void_)
        device_.submit([&](const vk::raii::CommandBuffer &commands) { film_->clear(commands); });
    film_is_void_ = false;
    return *film_;
}

ResolveToHost &RenderDevice::resolve_to_host() {
    DeviceFilm &film = this->film();
    if (!resolve_to_host_)
        resolve_to_host_.emplace(device_, resolve_pipelines(), film);
    return *resolve_to_host_;
}

ResolveToBuffer &RenderDevice::resolve_to_buffer() {
    DeviceFilm &film = this->film();
    if (!resolve_to_buffer_)
        resolve_to_buffer_.emplace(device_, resolve_pipelines(), film, ResolveToBuffer::piece_limits(device_.limits()));
    return *resolve_to_buffer_;
}

// The path tracer's kernel owns the scene's buffers.
void RenderDevice::read_first_hits(const std::shared_ptr<const View> &view, const RenderSettings &settings,
                                   const FirstHitQuery &query, const FirstHits::Receive &receive) {
    prepare(view, settings);
    if (!first_hits_)
        first_hits_.emplace(device_, code_.first_hit);
    first_hits_->read(kernel_->bound_scene(), query, target_seconds_ * tests_per_second_, receive);
}

ResolvePipelines &RenderDevice::resolve_pipelines() {
    if (!resolve_)
        resolve_.emplace(device_, code_.resolve);
    return *resolve_;
}

const vulkan::ComputePipeline &RenderDevice::estimate_pipeline() {
    if (!estimate_)
        estimate_.emplace(pt::estimate_pipeline(device_, code_.estimate));
    return *estimate_;
}

const vulkan::ComputePipeline &RenderDevice::add_pipeline() {
    if (!add_)
        add_.emplace(pt::add_pipeline(device_, code_.add));
    return *add_;
}

ErrorReader &RenderDevice::error_reader() {
    film();
    return bound_error_reader();
}

ErrorReader &RenderDevice::bound_error_reader() {
    if (!error_reader_)
        error_reader_.emplace(device_, estimate_pipeline(), *film_);
    return *error_reader_;
}

// A void film has no sums to move. Its first samples clear it.
void RenderDevice::start(const TileSlice &slice, const ErrorQuery *estimate) {
    if (!slice.takes && film_is_void_)
        return;
    Kernel::Behind behind;
    if (estimate)
        behind = [&reader = bound_error_reader(), estimate](const auto &commands) {
            reader.record(commands, *estimate);
        };
    const std::uint64_t tile_samples = slice.takes ? slice.tiles.size() * slice.samples.count() : 0;
    under_way_.push_back({tile_samples, kernel_->start(slice, film_is_void_, behind)});
    film_is_void_ = false;
}

RenderDevice::Finished RenderDevice::finish() {
    const Work work = under_way_.front();
    const double paths = paths_of(1, work.tile_samples);
    const double seconds = kernel_->finish(work.ticket, schedule_->expected_seconds(paths));
    under_way_.erase(under_way_.begin());
    if (work.tile_samples > 0)
        schedule_->measured(paths, seconds);
    return {work.tile_samples, seconds};
}

void RenderDevice::drain() noexcept {
    try {
        while (!is_idle())
            finish();
    } catch (...) {
        under_way_.clear();
    }
}

} // namespace pt
