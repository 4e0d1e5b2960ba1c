// One device's share of the rendering: its film, its kernel, and the slices that it has under way. Owned by Renderer,
// which deals samples to its devices; since the film's sums are exact, it does not matter which device takes which.
#pragma once

#include "lib/kernel/buffer_writer.h"
#include "lib/kernel/coverage.h"
#include "lib/kernel/device_film.h"
#include "lib/kernel/error_reader.h"
#include "lib/kernel/film_sum.h"
#include "lib/kernel/first_hits.h"
#include "lib/kernel/gpu_scene.h"
#include "lib/kernel/image_reader.h"
#include "lib/kernel/kernel.h"
#include "lib/kernel/resolve.h"
#include "lib/kernel/shader_source.h"
#include "lib/kernel/trace_pipelines.h"
#include "lib/render/schedule.h"
#include "lib/scene/render_settings.h"
#include "lib/vulkan/device.h"
#include "lib/vulkan/instance.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pt {

class RenderDevice {
public:
    // The instance must outlive it. target_seconds: aim for the time of a slice.
    RenderDevice(vulkan::Instance &instance, const vk::raii::PhysicalDevice &physical_device,
                 vulkan::LogicalDevice logical_device, const vulkan::DevicePolicy &policy, const KernelCode &code,
                 double target_seconds);
    // Waits for what is under way, as long as the device's patience allows.
    ~RenderDevice();
    RenderDevice(const RenderDevice &) = delete;
    RenderDevice &operator=(const RenderDevice &) = delete;

    vulkan::Device &device() { return device_; }
    const vulkan::Device &device() const { return device_; }

    // With the samples that this device has taken. Idle.
    DeviceFilm &film();

    // Of the film.
    ImageReader &image_reader();
    BufferWriter &buffer_writer();
    ErrorReader &error_reader();

    // Pixels of what camera rays meet first, of the image; see FirstHits::read(). Idle.
    void read_first_hits(const std::shared_ptr<const GpuScene> &scene, const RenderSettings &settings,
                         const FirstHitQuery &query, const FirstHits::Receive &receive);

    // Of pixels of the film's samples how many meet something; see Coverage::read(). Idle.
    void read_coverage(const std::shared_ptr<const GpuScene> &scene, const CoverageQuery &query,
                       const Coverage::Receive &receive);

    // Kernels for other films than this device's own.
    ResolvePipelines &resolve_pipelines();
    const vulkan::ComputePipeline &estimate_pipeline();
    const vulkan::ComputePipeline &add_pipeline();

    // Takes over kernels that the caller has kept, and hands over those that are built.
    void keep_kernels(const vulkan::KernelStore &store);
    void save_kernels() noexcept;

    // What the film of these settings takes of this device. Throws PT_ERROR_UNSUPPORTED if it has not so much.
    DeviceFilm make_film(const RenderSettings &settings);
    void set_film(DeviceFilm film);

    // What the film holds is void.
    void discard_samples() noexcept;

    // Pipelines of other code, built as far as the kernel needs them if there is one. Throws PT_ERROR_SHADER if the
    // driver refuses the code.
    std::unique_ptr<TracePipelines> make_pipelines(const KernelCode &code);
    void set_pipelines(const KernelCode &code, std::unique_ptr<TracePipelines> pipelines) noexcept;

    // Makes the kernel, or shows it this scene, unless it has it. After set_film. Idle.
    void prepare(const std::shared_ptr<const GpuScene> &scene, const RenderSettings &settings);

    // The same, with all that the kernel will need, as fast as it can be.
    void prepare_ahead(const std::shared_ptr<const GpuScene> &scene, const RenderSettings &settings);

    // Builds all that samples of the scene need from here on, until the next prepare(), and what looks at errors.
    void prepare_for_polls(bool with_errors);

    bool has_room() const { return under_way_.size() < device_.policy().queue_depth; }
    bool is_idle() const { return under_way_.empty(); }

    const Schedule &schedule() const { return *schedule_; }

    // Whether the error of the film can be estimated in the submission that takes samples.
    bool estimates_behind() const { return device_.policy().resolve_on_device && film_->strips().size() == 1; }

    // Starts a slice. has_room() must hold. estimate: if it is given, the error of the film with these samples is
    // estimated behind them, for error_reader().collect(); estimates_behind() must hold.
    void start(const TileSlice &slice, const ErrorQuery *estimate = nullptr);

    // Whether finish() would not wait, having waited for that until a time. Not idle.
    bool is_done(vulkan::Device::Clock::time_point until) { return device_.is_done(under_way_.front().ticket, until); }

    // Looks which slices have ended while nobody waited for them. Without, a slice is taken to end when it is seen to.
    void look() { device_.look(); }

    // Waits for the slice that was started first. seconds: where nobody saw it end, what comes nearest to what was
    // expected of it.
    struct Finished {
        std::uint64_t tile_samples; // tiles times samples; 0 where another device took them
        double seconds;
    };
    Finished finish();

    // Waits for all slices that were started, and knows nothing of them afterwards.
    void drain() noexcept;

private:
    struct Work {
        std::uint64_t tile_samples;
        vulkan::Device::Ticket ticket;
    };

    void plant(const std::shared_ptr<const SphereTree> &tree);
    void drop_kernel() noexcept;
    void drop_bound() noexcept; // the kernel and whatever else has descriptor sets with the film
    ErrorReader &bound_error_reader();

    vulkan::Device device_;
    KernelCode code_;
    std::unique_ptr<TracePipelines> pipelines_; // never NULL
    double target_seconds_;
    double tests_per_second_;                 // that it is taken to manage with a kernel that has not been measured
    std::optional<ResolvePipelines> resolve_; // of the code, once an image was read
    std::optional<vulkan::ComputePipeline> estimate_; // likewise, once an error was asked for
    std::optional<vulkan::ComputePipeline> add_;      // once films of several devices met on this one
    std::optional<DeviceFilm> film_;
    std::optional<ImageReader> image_reader_; // of the film, likewise
    std::optional<BufferWriter> buffer_writer_;
    std::optional<ErrorReader> error_reader_;
    std::shared_ptr<const SphereTree> tree_; // that is in the buffer
    std::optional<vulkan::Buffer> tree_buffer_;
    std::optional<FirstHits> first_hits_; // of the code, once they were asked for
    std::optional<Coverage> coverage_;    // likewise
    std::optional<Kernel> kernel_;
    std::optional<Schedule> schedule_; // of the kernel
    std::vector<Work> under_way_;      // in the order of their starts; has room for all that there may be
    bool film_is_void_ = true;         // it is to be cleared before it is used
};

} // namespace pt
