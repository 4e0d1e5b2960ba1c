// One device's share of the rendering: its film, its kernel, and its slices under way. Owned by Renderer, which deals
// samples to its devices. The sums of the film are exact, so it does not matter which device takes which sample.
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
    // The instance must outlive it. target_seconds: how long a slice should take. caller: see vulkan::Device.
    RenderDevice(vulkan::Instance &instance, const vk::raii::PhysicalDevice &physical_device,
                 const vulkan::DevicePolicy &policy, const KernelCode &code, double target_seconds,
                 const vulkan::CallerVulkan *caller = nullptr);
    // Waits for work under way, for as long as the patience of the device allows.
    ~RenderDevice();
    RenderDevice(const RenderDevice &) = delete;
    RenderDevice &operator=(const RenderDevice &) = delete;

    vulkan::Device &device() { return device_; }
    const vulkan::Device &device() const { return device_; }

    // The film with the samples that this device has taken. Only while no work is under way.
    DeviceFilm &film();

    // Reads the film.
    ImageReader &image_reader();
    BufferWriter &buffer_writer();
    ErrorReader &error_reader();

    // Pixels of what camera rays meet first; see FirstHits::read(). Only while no work is under way.
    void read_first_hits(const std::shared_ptr<const GpuScene> &scene, const RenderSettings &settings,
                         const FirstHitQuery &query, const FirstHits::Receive &receive);

    // How many camera rays of the samples meet a surface, by pixel; see Coverage::read(). Only while no work is under
    // way.
    void read_coverage(const std::shared_ptr<const GpuScene> &scene, const CoverageQuery &query,
                       const Coverage::Receive &receive);

    // The kernels, for use with films other than this device's own.
    ResolvePipelines &resolve_pipelines();
    const vulkan::ComputePipeline &estimate_pipeline();
    const vulkan::ComputePipeline &add_pipeline();

    // Takes over kernels that the caller has kept, and hands over those that are built.
    void keep_kernels(const vulkan::KernelStore &store);
    void save_kernels() noexcept;

    // Makes a film for these settings on this device. Throws PT_ERROR_UNSUPPORTED if the device is too small for it.
    DeviceFilm make_film(const RenderSettings &settings);
    void set_film(DeviceFilm film);

    // The film is void from here on.
    void discard_samples() noexcept;

    // Pipelines for other code, built as far as the present kernel needs them. Throws PT_ERROR_SHADER if the driver
    // refuses the code.
    std::unique_ptr<TracePipelines> make_pipelines(const KernelCode &code);
    void set_pipelines(const KernelCode &code, std::unique_ptr<TracePipelines> pipelines) noexcept;

    // Makes a kernel for this scene, or shows the scene to the one that is there. After set_film, and only while no
    // work is under way.
    void prepare(const std::shared_ptr<const GpuScene> &scene, const RenderSettings &settings);

    // The same, and builds everything that the kernel will need, in its fastest form.
    void prepare_ahead(const std::shared_ptr<const GpuScene> &scene, const RenderSettings &settings);

    // Builds everything that samples of the scene need until the next prepare(), and what looks at errors.
    void prepare_for_polls(bool with_errors);

    bool has_room() const { return under_way_.size() < device_.policy().queue_depth; }
    bool is_idle() const { return under_way_.empty(); }

    const Schedule &schedule() const { return *schedule_; }

    // Whether the error of the film can be estimated in the submission that takes samples.
    bool estimates_behind() const { return device_.policy().resolve_on_device && film_->strips().size() == 1; }

    // Starts a slice. has_room() must hold. estimate: if given, the error of the film with these samples is estimated
    // after them, for error_reader().collect(); estimates_behind() must hold.
    void start(const TileSlice &slice, const ErrorQuery *estimate = nullptr);

    // Whether finish() would return at once, after waiting for that until a given time. Only while work is under way.
    bool is_done(vulkan::Device::Clock::time_point until) { return device_.is_done(under_way_.front().ticket, until); }

    // Notes which slices have ended while nobody waited for them. Without this, a slice counts as ended when somebody
    // looks.
    void look() { device_.look(); }

    // Waits for the slice that was started first. seconds: its duration, or if nobody saw it end, the nearest estimate
    // to what was expected.
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

using RenderDevices = std::vector<std::unique_ptr<RenderDevice>>; // of a renderer, at least one

// Hands to the caller, at the end of a call, the kernels that were built in it.
class KernelsKept {
public:
    explicit KernelsKept(const RenderDevices &devices) : devices_(devices) {}
    KernelsKept(const KernelsKept &) = delete;
    KernelsKept &operator=(const KernelsKept &) = delete;
    ~KernelsKept() {
        for (const auto &device : devices_)
            device->save_kernels();
    }

private:
    const RenderDevices &devices_;
};

} // namespace pt
