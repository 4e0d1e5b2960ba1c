// One device's share of the rendering: its film, its kernel, and the slices that it has under way. Owned by Renderer,
// which deals samples to its devices; since the film's sums are exact, it does not matter which device takes which.
#pragma once

#include "lib/film/device_film.h"
#include "lib/kernel/buffer_writer.h"
#include "lib/kernel/coverage.h"
#include "lib/kernel/error_reader.h"
#include "lib/kernel/film_sum.h"
#include "lib/kernel/first_hits.h"
#include "lib/kernel/gpu_scene.h"
#include "lib/kernel/image_reader.h"
#include "lib/kernel/kernel.h"
#include "lib/kernel/resolve.h"
#include "lib/kernel/shader_source.h"
#include "lib/kernel/trace_pipelines.h"
#include "lib/render/render_settings.h"
#include "lib/render/schedule.h"
#include "lib/vulkan/device.h"
#include "lib/vulkan/instance.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace pt {

// Samples of some tiles, which lie in one part of the film.
struct TileSlice {
    std::span<const std::uint32_t> tiles; // ascending
    SampleRange before;                   // from the first to the last sample that they have; empty if they have none
    SampleRange samples;
    bool takes; // them, instead of making room for them alone: where another device takes them

    std::uint64_t split() const { return split_of(before.empty() ? samples : hull_of(before, samples)); }
    bool moves_split() const { return !before.empty() && split_of(before) != split(); }
    bool begins_part() const { return pt::begins_part(before, split(), samples.first); }
};

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

    // Brought up to date first, so that it holds the whole samples that this device has taken. Idle.
    DeviceFilm &film();
    std::uint32_t pixel_count() const { return film_->pixel_count(); }

    // Of the film, brought up to date.
    ImageReader &image_reader();
    BufferWriter &buffer_writer();
    ErrorReader &error_reader();
    ErrorReader &uneven_error_reader(); // of tiles that may have different samples

    // Pixels of what camera rays meet first, of the image; see FirstHits::read(). Idle.
    void read_first_hits(const std::shared_ptr<const GpuScene> &scene, const RenderSettings &settings,
                         const FirstHitQuery &query, const FirstHits::Receive &receive);

    // Of pixels of the film's samples how many meet something; see Coverage::read(). Idle.
    void read_coverage(const std::shared_ptr<const GpuScene> &scene, const CoverageQuery &query,
                       const Coverage::Receive &receive);

    // Kernels for other films than this device's own.
    ResolvePipelines &resolve_pipelines();
    const vulkan::ComputePipeline &estimate_pipeline();
    const vulkan::ComputePipeline &uneven_estimate_pipeline();
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

    // Builds all that samples of the scene need from here on, until the next prepare(): of tiles, and where errors are
    // looked at.
    void prepare_for_polls(bool by_tile, bool with_errors);

    // Pixels of a pass of one sample over all pixels that slices started so far have taken; 0 between passes.
    std::uint32_t pass_pixels() const { return pass_pixels_; }

    // The sample of the pass under way, or no sample.
    SampleRange pass() const {
        return pass_pixels_ > 0 ? SampleRange{pass_sample_, std::uint64_t{pass_sample_} + 1} : SampleRange{};
    }

    // Ends the pass under way, of which the film has nothing. Idle.
    void discard_pass();

    bool has_room() const { return under_way_.size() < device_.policy().queue_depth; }
    bool is_idle() const { return under_way_.empty(); }

    // Whether the film needs work before it takes the next sample: to be emptied, or to have a pass added whose samples
    // are complete. Not within a pass.
    bool film_is_behind() const { return uncleared_pixels_ + uncommitted_pixels_ > 0; }

    // Starts a slice: of the work on the film, if it is behind, the next of the pass under way, or one of the first of
    // these samples, if there are any; clearing the film may be a part of it. hull: of those that this device and
    // others have begun before. estimate: if it is given, and the slice takes all of the samples, the error of the film
    // with them is estimated behind it where that can be, for error_reader().collect(). has_room() must hold.
    struct Started {
        std::uint32_t samples; // that the slice has begun: 0 for the film and within a pass
        bool estimates;
    };
    Started start(const SampleRange &samples, const SampleRange &hull,
                  const std::optional<ErrorQuery> &estimate = std::nullopt);

    // Of a slice of so many tiles how many samples are affordable, of those that there are; and of so many samples how
    // many tiles: 1 at least.
    std::uint64_t affordable_samples(std::size_t tile_count, std::uint64_t most) const;
    std::size_t affordable_tiles(std::uint64_t sample_count) const;

    // Starts a slice of tiles. has_room() must hold, film_is_behind() and a pass under way must not.
    void start_tiles(const TileSlice &slice);

    // Brings the parts of a film with the same samples in all tiles to the split of those of other films too. Idle.
    void fold_to(const SampleRange &hull);

    // Whether the film's tiles lie each in one of its strips.
    bool has_whole_regions() const { return film_->has_whole_regions(); }

    // All tiles have samples within this range alone.
    void cover(const SampleRange &hull);

    // Whether finish() would not wait, having waited for that until a time. Not idle.
    bool is_done(vulkan::Device::Clock::time_point until) { return device_.is_done(under_way_.front().ticket, until); }

    // Looks which slices have ended while nobody waited for them. Without, a slice is taken to end when it is seen to.
    void look() { device_.look(); }

    // Waits for the slice that was started first. seconds: where nobody saw it end, what comes nearest to what was
    // expected of it.
    struct Finished {
        std::uint64_t paths; // samples in all its pixels; 0 of work on the film
        double seconds;
    };
    Finished finish();

    // Waits for all slices that were started, and knows nothing of them afterwards.
    void drain() noexcept;

private:
    struct Work {
        Slice slice;
        vulkan::Device::Ticket ticket;
        bool on_film; // takes no samples
    };

    bool can_clear_at_once() const;
    void plant(const std::shared_ptr<const SphereTree> &tree);
    void drop_kernel() noexcept;
    void drop_bound() noexcept; // the kernel and whatever else has descriptor sets with the film
    void start_film_work();
    Started start_samples(const SampleRange &samples, const SampleRange &hull,
                          const std::optional<ErrorQuery> &estimate);
    ErrorReader &bound_error_reader();

    vulkan::Device device_;
    KernelCode code_;
    std::unique_ptr<TracePipelines> pipelines_; // never NULL
    double target_seconds_;
    double tests_per_second_;                 // that it is taken to manage with a kernel that has not been measured
    std::optional<ResolvePipelines> resolve_; // of the code, once an image was read
    std::optional<vulkan::ComputePipeline> estimate_;        // likewise, once an error was asked for
    std::optional<vulkan::ComputePipeline> uneven_estimate_; // likewise
    std::optional<vulkan::ComputePipeline> add_;             // once films of several devices met on this one
    std::optional<DeviceFilm> film_;
    std::optional<ImageReader> image_reader_; // of the film, likewise
    std::optional<BufferWriter> buffer_writer_;
    std::optional<ErrorReader> error_reader_;
    std::optional<ErrorReader> uneven_error_reader_;
    std::shared_ptr<const SphereTree> tree_; // that is in the buffer
    std::optional<vulkan::Buffer> tree_buffer_;
    std::optional<FirstHits> first_hits_; // of the code, once they were asked for
    std::optional<Coverage> coverage_;    // likewise
    std::optional<Kernel> kernel_;
    std::optional<Schedule> schedule_;      // of the kernel
    std::optional<Schedule> film_schedule_; // of the work on the film, a pixel of it being a path
    std::vector<Work> under_way_;           // in the order of their starts; has room for all that there may be
    std::uint32_t pass_pixels_ = 0;
    std::uint32_t pass_sample_ = 0;        // index of the pass's sample
    SampleRange pass_hull_;                // of the samples begun before it
    std::uint32_t uncleared_pixels_ = 0;   // at the film's end, that still hold what is void
    std::uint32_t uncommitted_pixels_ = 0; // at the film's end, without the pass's sample, which is complete
};

} // namespace pt
