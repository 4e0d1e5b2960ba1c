#pragma once

#include "lib/kernel/device_film.h"
#include "lib/kernel/scene_kernel.h"
#include "lib/kernel/tile_lists.h"
#include "lib/kernel/tile_slice.h"
#include "lib/kernel/trace_pipelines.h"
#include "lib/points/point_sequence.h"
#include "lib/scene/render_settings.h"
#include "lib/view/scene_features.h"
#include "lib/view/view.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"
#include "shaders/gpu_layout.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace pt {

class Kernel {
public:
    // Throws PT_ERROR_UNSUPPORTED if the device is too small for the scene.
    Kernel(vulkan::Device &device, TracePipelines &pipelines, DeviceFilm &film, const vulkan::Buffer *tree,
           std::shared_ptr<const View> view, const RenderSettings &settings);

    const Features &features() const { return view_->features; }

    // show() needs a view with the same features. No work may be running.
    const View &view() const { return *view_; }
    bool can_show(const View &view) const;
    void show(std::shared_ptr<const View> view, const RenderSettings &settings);

    // The scene's buffers for other kernels. No work may be running.
    BoundScene bound_scene();

    void build(TracePipelines &pipelines) const;

    // Dispatches no workgroups, because some drivers compile only at the first dispatch. No work may be running.
    void dispatch_nothing();

    std::uint32_t max_samples() const { return max_dispatch_samples_ * (max_tables - 1); }

    using Behind = std::function<void(const vk::raii::CommandBuffer &)>;

    // At most queue_depth slices may be running.
    vulkan::Device::Ticket start(const TileSlice &slice, bool on_cleared_film, const Behind &behind = {});

    double finish(vulkan::Device::Ticket ticket, double expected_seconds = 0.0);

private:
    // Each dispatch of a slice has its own table of points. Together the tables take at most 4 MiB. A split of the
    // samples may add one dispatch.
    static constexpr std::uint32_t max_tables = 64;

    struct Batch {
        std::uint32_t first_sample;
        std::uint32_t sample_count;
        std::uint32_t table_offset;
        FilmPart part;
        bool begins_part;

        SampleRange range() const { return {first_sample, std::uint64_t{first_sample} + sample_count}; }
    };

    std::vector<Batch> next_batches(const TileSlice &slice);
    void upload_points(const std::vector<Batch> &batches);
    void upload_scene();
    void bind_film(const vulkan::ComputePipeline &trace);
    void dispatch(const vk::raii::CommandBuffer &commands, const vulkan::ComputePipeline &pipeline,
                  std::span<const std::uint32_t> tiles, gpu::FrameConstants frame, std::uint32_t table_offset) const;
    std::uint32_t sharers_of(std::size_t tile_count, std::uint32_t sample_count) const;

    // Overlapping dispatches cannot overwrite, because they add atomically.
    std::uint32_t overwrites(bool part_is_empty) const { return part_is_empty && !overlap_ ? 1 : 0; }

    vulkan::Device &device_;
    TracePipelines &pipelines_;
    DeviceFilm &film_;
    std::shared_ptr<const View> view_;
    PointLayout layout_;
    std::uint64_t seed_;
    gpu::FrameConstants frame_;
    std::uint32_t table_bytes_;
    std::uint32_t max_dispatch_samples_;
    bool overlap_;
    vulkan::Buffer scene_;
    const vulkan::Buffer *tree_;
    vulkan::Buffer points_;
    TileLists tile_lists_;
    std::vector<vulkan::DescriptorSet> sets_;
    std::uint32_t next_table_ = 0;
    bool scene_is_old_ = true;
    double seconds_ = 0.0;
};

} // namespace pt
