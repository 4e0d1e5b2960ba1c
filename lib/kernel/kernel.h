// The path-tracing kernel, ready to run: specialised to what scenes have in common, with the buffers that it reads.
// Owned by RenderDevice, which makes a new one for a scene with other features.
#pragma once

#include "lib/film/device_film.h"
#include "lib/kernel/gpu_scene.h"
#include "lib/kernel/point_sequence.h"
#include "lib/kernel/scene_features.h"
#include "lib/kernel/trace_pipelines.h"
#include "lib/render/render_settings.h"
#include "lib/render/schedule.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"
#include "shaders/gpu_layout.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace pt {

class Kernel {
public:
    // device, pipelines, film and tree must outlive the kernel. tree: the buffer of the scene's, NULL if it has none.
    // Throws PT_ERROR_UNSUPPORTED for scenes beyond the device.
    Kernel(vulkan::Device &device, TracePipelines &pipelines, DeviceFilm &film, vulkan::Buffer *tree,
           std::shared_ptr<const GpuScene> scene, const RenderSettings &settings);

    const Features &features() const { return features_; }

    // The scene that is rendered next; those that show() takes have as much in common with it as a kernel asks for.
    // Idle.
    const GpuScene &scene() const { return *gpu_scene_; }
    bool can_show(const GpuScene &scene) const;
    void show(std::shared_ptr<const GpuScene> scene, const RenderSettings &settings);

    // Builds what this kernel runs of pipelines of the same device, be they other ones than its own; by_tile: for lists
    // of tiles too. Throws PT_ERROR_SHADER if the driver refuses that.
    void build(TracePipelines &pipelines, bool by_tile) const;

    // Dispatches no work at all: some drivers compile a kernel no sooner than it is dispatched. None may be under way.
    void dispatch_nothing();

    // The samples that one submission may add to a pixel.
    std::uint32_t max_samples() const;

    // Records what follows the samples in their submission; parts: of the film, as they are used then.
    using Behind = std::function<void(const vk::raii::CommandBuffer &, const PartUse &parts)>;

    // Starts to take the samples of a slice, of which first_sample is the index of the first; those of a split pass are
    // kept aside. hull: of the samples that this device and others that render the same have begun before. At most the
    // device's queue_depth of slices may be under way. on_cleared_film: all pixels of the film are cleared first.
    vulkan::Device::Ticket start(const Slice &slice, std::uint32_t first_sample, const SampleRange &hull,
                                 bool on_cleared_film, const Behind &behind = {});

    // Starts to add a range of a split pass of that sample to the film, once all of the pass has been started. The film
    // holds whole samples again with the range that ends it.
    vulkan::Device::Ticket commit(const Slice &range, std::uint32_t sample, const SampleRange &hull);

    // Where samples are added.
    struct FilmTarget {
        std::uint32_t part; // in memory
        bool is_empty;      // of samples of these pixels
    };

    // Samples of some tiles of a film that has whole rows of regions.
    struct TileWork {
        std::span<const std::uint32_t> tiles; // ascending
        SampleRange samples;                  // all of one part of the film; none, if there is only to fold
        FilmTarget target;
        std::optional<std::uint32_t> fold_into; // the part in memory that takes in the other one first
    };

    // Starts to take them; like start().
    vulkan::Device::Ticket start_tiles(const TileWork &work);

    // Starts to bring the film's parts to the split of samples that others have begun.
    vulkan::Device::Ticket start_fold(const SampleRange &hull);

    // Waits for a slice of start() and returns the seconds it took, or where these are not known what comes nearest to
    // those expected.
    double finish(vulkan::Device::Ticket ticket, double expected_seconds = 0.0);

private:
    // Samples that a dispatch takes, and where the table of their points is.
    struct Batch {
        std::uint32_t first_sample;
        std::uint32_t sample_count;
        std::uint32_t table_offset; // bytes
        bool begins_part;           // of the film, which has no samples of this device's yet

        SampleRange range() const { return {first_sample, std::uint64_t{first_sample} + sample_count}; }
    };

    Batch next_batch(const SampleRange &samples);
    std::vector<Batch> next_batches(const SampleRange &samples, std::uint64_t split, SampleRange before);
    void upload_points(const std::vector<Batch> &batches);
    void bind_film(const vulkan::ComputePipeline &trace);
    void prepare_pass();
    void prepare_tiles();
    std::uint32_t list_tiles(std::span<const std::uint32_t> tiles);
    void dispatch_tiles(const vk::raii::CommandBuffer &commands, const vulkan::ComputePipeline &pipeline,
                        std::span<const std::uint32_t> tiles, std::uint32_t first_entry, gpu::FrameConstants frame,
                        std::uint32_t table_offset, std::uint32_t sharers) const;
    vulkan::DescriptorSet bound(const vulkan::ComputePipeline &trace, const DeviceFilm::Strip &strip,
                                const vulkan::Buffer &pass) const;
    void upload_scene();
    bool scene_fits_commands() const;
    void dispatch(const vk::raii::CommandBuffer &commands, const vulkan::ComputePipeline &pipeline, const Slice &slice,
                  const Batch &batch, const FilmTarget &target, std::uint32_t invocations_per_pixel) const;
    std::uint32_t overwrites(const FilmTarget &target) const;
    bool folds_on_host() const;

    vulkan::Device &device_;
    TracePipelines &pipelines_;
    DeviceFilm &film_;
    std::shared_ptr<const GpuScene> gpu_scene_; // never NULL
    Features features_;
    PointLayout layout_;
    std::uint32_t sampler_;
    std::uint64_t seed_;
    std::uint32_t first_pixel_; // of the film, in the image
    gpu::FrameConstants frame_;
    std::uint32_t table_bytes_;          // of the points that a dispatch sees
    std::uint32_t sharers_;              // invocations to a pixel
    std::uint32_t max_dispatch_samples_; // per pixel
    bool overlap_;                       // dispatches may add to the film at the same time
    vulkan::Buffer scene_;
    vulkan::Buffer *tree_;                         // NULL if there is none
    vulkan::Buffer points_;                        // tables of the slices under way
    std::vector<vulkan::DescriptorSet> sets_;      // one per strip of the film
    std::vector<vulkan::DescriptorSet> pass_sets_; // likewise with the pass, if there has been one
    std::optional<vulkan::Buffer> tile_lists_;     // of the slices under way, if there has been one of tiles
    std::vector<vulkan::DescriptorSet> tile_sets_; // with them
    std::uint32_t next_tile_list_ = 0;             // in tile_lists_, which is used in turn
    std::uint32_t next_table_ = 0;                 // in points_, which is used in turn
    bool scene_is_old_ = true;                     // the buffer does not have the scene yet
    double seconds_ = 0.0;                         // of all slices of the scene so far
};

} // namespace pt
