// The path-tracing kernel, ready to run: specialised to what scenes have in common, with the buffers that it reads.
// Owned by RenderDevice, which makes a new one for a scene with other features.
#pragma once

#include "lib/kernel/device_film.h"
#include "lib/kernel/gpu_scene.h"
#include "lib/kernel/point_sequence.h"
#include "lib/kernel/scene_features.h"
#include "lib/kernel/scene_kernel.h"
#include "lib/kernel/tile_lists.h"
#include "lib/kernel/tile_slice.h"
#include "lib/kernel/trace_pipelines.h"
#include "lib/scene/render_settings.h"
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
    // device, pipelines, film and tree must outlive the kernel. tree: the buffer of the scene's tree, NULL if it has
    // none. Throws PT_ERROR_UNSUPPORTED for scenes beyond the device.
    Kernel(vulkan::Device &device, TracePipelines &pipelines, DeviceFilm &film, const vulkan::Buffer *tree,
           std::shared_ptr<const GpuScene> scene, const RenderSettings &settings);

    const Features &features() const { return gpu_scene_->features; }

    // The scene that is rendered next. show() takes scenes that have the same features. Only while no work is under
    // way.
    const GpuScene &scene() const { return *gpu_scene_; }
    bool can_show(const GpuScene &scene) const;
    void show(std::shared_ptr<const GpuScene> scene, const RenderSettings &settings);

    // The scene in its buffers, for other kernels. Only while no work is under way.
    BoundScene bound_scene();

    // Builds the pipelines that this kernel runs, in its own cache or in another one of the same device. Throws
    // PT_ERROR_SHADER if the driver refuses one.
    void build(TracePipelines &pipelines) const;

    // Dispatches zero workgroups: some drivers compile a kernel only when it is first dispatched. No work may be under
    // way.
    void dispatch_nothing();

    // How many samples one submission may add to a pixel.
    std::uint32_t max_samples() const { return max_dispatch_samples_ * (max_tables - 1); }

    // Records commands that follow the samples in their submission.
    using Behind = std::function<void(const vk::raii::CommandBuffer &)>;

    // Starts to take the samples of a slice. At most queue_depth slices of the device may be under way.
    // on_cleared_film: all pixels of the film are cleared first.
    vulkan::Device::Ticket start(const TileSlice &slice, bool on_cleared_film, const Behind &behind = {});

    // Waits for a slice that start() began and returns the seconds that it took. Where the device cannot tell, it
    // returns the nearest estimate to what was expected.
    double finish(vulkan::Device::Ticket ticket, double expected_seconds = 0.0);

private:
    // Tables of points for one slice, at most 4 MiB: one for each dispatch. The split of the film may add one more cut.
    static constexpr std::uint32_t max_tables = 64;

    // The samples of one dispatch, all for one part of the film, and where their points begin in the table.
    struct Batch {
        std::uint32_t first_sample;
        std::uint32_t sample_count;
        std::uint32_t table_offset; // bytes
        FilmPart part;
        bool begins_part; // which has no samples of these pixels yet

        SampleRange range() const { return {first_sample, std::uint64_t{first_sample} + sample_count}; }
    };

    std::vector<Batch> next_batches(const TileSlice &slice);
    void upload_points(const std::vector<Batch> &batches);
    void upload_scene();
    void bind_film(const vulkan::ComputePipeline &trace);
    void dispatch(const vk::raii::CommandBuffer &commands, const vulkan::ComputePipeline &pipeline,
                  std::span<const std::uint32_t> tiles, gpu::FrameConstants frame, std::uint32_t table_offset) const;
    std::uint32_t sharers_of(std::size_t tile_count, std::uint32_t sample_count) const;
    bool folds_on_host() const;

    // Whether a dispatch may overwrite its part instead of adding to it. Dispatches that overlap add with atomic
    // operations.
    std::uint32_t overwrites(bool part_is_empty) const { return part_is_empty && !overlap_ ? 1 : 0; }

    vulkan::Device &device_;
    TracePipelines &pipelines_;
    DeviceFilm &film_;
    std::shared_ptr<const GpuScene> gpu_scene_; // never NULL
    PointLayout layout_;
    std::uint64_t seed_;
    gpu::FrameConstants frame_;
    std::uint32_t table_bytes_;          // of the points that a dispatch sees
    std::uint32_t max_dispatch_samples_; // per pixel
    bool overlap_;                       // dispatches may add to the film at the same time
    vulkan::Buffer scene_;
    const vulkan::Buffer *tree_; // NULL if there is none
    vulkan::Buffer points_;      // tables of the slices under way
    TileLists tile_lists_;
    std::vector<vulkan::DescriptorSet> sets_; // one per strip of the film
    std::uint32_t next_table_ = 0;            // in points_, which is used in turn
    bool scene_is_old_ = true;                // the buffer does not have the scene yet
    double seconds_ = 0.0;                    // of all slices of the scene so far
};

} // namespace pt
