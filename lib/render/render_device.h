// One device of a context. Any device may take any samples, because films are exact sums.
#pragma once

#include "lib/code/shader_source.h"
#include "lib/kernel/device_film.h"
#include "lib/kernel/error_reader.h"
#include "lib/kernel/film_sum.h"
#include "lib/kernel/first_hits.h"
#include "lib/kernel/kernel.h"
#include "lib/kernel/resolve.h"
#include "lib/kernel/resolve_to_buffer.h"
#include "lib/kernel/resolve_to_host.h"
#include "lib/kernel/trace_pipelines.h"
#include "lib/render/schedule.h"
#include "lib/scene/render_settings.h"
#include "lib/view/view.h"
#include "lib/vulkan/device.h"
#include "lib/vulkan/instance.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pt {

class RenderDevice {
public:
    // `target_seconds` is the intended time of a slice. vulkan::Device describes `caller`.
    RenderDevice(vulkan::Instance &instance, const vk::raii::PhysicalDevice &physical_device,
                 const vulkan::DevicePolicy &policy, const KernelCode &code, double target_seconds,
                 const vulkan::CallerVulkan *caller = nullptr);
    // Waits for running work, up to DevicePolicy's limit.
    ~RenderDevice();
    RenderDevice(const RenderDevice &) = delete;
    RenderDevice &operator=(const RenderDevice &) = delete;

    vulkan::Device &device() { return device_; }
    const vulkan::Device &device() const { return device_; }

    // No work may be running.
    DeviceFilm &film();

    ResolveToHost &resolve_to_host();
    ResolveToBuffer &resolve_to_buffer();
    ErrorReader &error_reader();

    // No work may be running.
    void read_first_hits(const std::shared_ptr<const View> &view, const RenderSettings &settings,
                         const FirstHitQuery &query, const FirstHits::Receive &receive);

    ResolvePipelines &resolve_pipelines();
    const vulkan::ComputePipeline &estimate_pipeline();
    const vulkan::ComputePipeline &add_pipeline();

    void keep_kernels(const vulkan::KernelStore &store);
    void save_kernels() noexcept;

    // Throws PT_ERROR_UNSUPPORTED if the device has too little memory.
    DeviceFilm make_film(const RenderSettings &settings);
    void set_film(DeviceFilm film);

    void discard_samples() noexcept;

    // Makes pipelines like the present kernel's from other code. Throws PT_ERROR_SHADER if the driver refuses the code.
    std::unique_ptr<TracePipelines> make_pipelines(const KernelCode &code);
    void set_pipelines(const KernelCode &code, std::unique_ptr<TracePipelines> pipelines) noexcept;

    // Makes a kernel for this view, or uses the present kernel if it suits the view. Needs a film. No work may be
    // running.
    void prepare(const std::shared_ptr<const View> &view, const RenderSettings &settings);

    void prepare_ahead(const std::shared_ptr<const View> &view, const RenderSettings &settings);

    // Builds everything that start() needs until the next prepare(), because pt_poll must not build.
    void prepare_for_polls(bool with_errors);

    bool has_room() const { return under_way_.size() < device_.policy().queue_depth; }
    bool is_idle() const { return under_way_.empty(); }

    const Schedule &schedule() const { return *schedule_; }

    bool estimates_behind() const { return device_.policy().resolve_on_device && film_->strips().size() == 1; }

    // Requires has_room(). With `estimate`, also estimates the error for error_reader().collect(), which requires
    // estimates_behind().
    void start(const TileSlice &slice, const ErrorQuery *estimate = nullptr);

    // Returns whether finish() would return at once. Work must be running.
    bool is_done(vulkan::Device::Clock::time_point until) { return device_.is_done(under_way_.front().ticket, until); }

    void look() { device_.look(); }

    // Waits for the oldest slice. `seconds` is estimated if neither look() nor is_done() saw the slice end.
    struct Finished {
        std::uint64_t tile_samples; // 0 if another device took the samples
        double seconds;
    };
    Finished finish();

    void drain() noexcept;

private:
    struct Work {
        std::uint64_t tile_samples;
        vulkan::Device::Ticket ticket;
    };

    void plant(const std::shared_ptr<const SphereTree> &tree);
    void drop_kernel() noexcept;
    void drop_bound() noexcept; // drops the kernel and all descriptor sets of the film
    ErrorReader &bound_error_reader();

    vulkan::Device device_;
    KernelCode code_;
    std::unique_ptr<TracePipelines> pipelines_;
    double target_seconds_;
    double tests_per_second_; // an assumption until the first measurement
    std::optional<ResolvePipelines> resolve_;
    std::optional<vulkan::ComputePipeline> estimate_;
    std::optional<vulkan::ComputePipeline> add_;
    std::optional<DeviceFilm> film_;
    std::optional<ResolveToHost> resolve_to_host_;
    std::optional<ResolveToBuffer> resolve_to_buffer_;
    std::optional<ErrorReader> error_reader_;
    std::shared_ptr<const SphereTree> tree_;
    std::optional<vulkan::Buffer> tree_buffer_;
    std::optional<FirstHits> first_hits_;
    std::optional<Kernel> kernel_;
    std::optional<Schedule> schedule_;
    std::vector<Work> under_way_;
    bool film_is_void_ = true;
};

using RenderDevices = std::vector<std::unique_ptr<RenderDevice>>;

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
