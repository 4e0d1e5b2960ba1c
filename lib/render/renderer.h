#pragma once

#include "lib/base/error.h"
#include "lib/base/log.h"
#include "lib/base/work_progress.h"
#include "lib/code/shader_source.h"
#include "lib/film/adaptive_rule.h"
#include "lib/film/error_estimate.h"
#include "lib/film/film_header.h"
#include "lib/film/tile_samples.h"
#include "lib/kernel/device_film.h"
#include "lib/render/accumulation.h"
#include "lib/render/film_view.h"
#include "lib/render/image.h"
#include "lib/render/render_device.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"
#include "lib/scene/scene.h"
#include "lib/view/prepared_scene.h"
#include "lib/view/small_lamps.h"
#include "lib/view/view.h"
#include "lib/vulkan/caller_vulkan.h"
#include "lib/vulkan/instance.h"
#include "lib/vulkan/pipeline_cache.h"

#include <pt/accuracy.h>
#include <pt/devices.h>
#include <pt/stats.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pt {

// A checked pt_create_info with defaults applied.
struct CreateSettings {
    bool validation = false;
    bool scene_kernels = true;    // on devices where they are faster
    std::string device;           // empty for the best device
    std::string shader_directory; // empty for built-in kernels
    Log log;
    std::uint32_t submit_milliseconds = 50;
    std::optional<vulkan::CallerVulkan> vulkan; // none if the library makes its own device
    vulkan::KernelStore kernel_store;
    std::uint32_t devices_of_each = 1;          // for tests
    bool like_gpus = false;                     // for tests on CPUs
    std::optional<std::uint32_t> tree_from{};   // for tests
    std::optional<std::uint32_t> adaptive_from; // for tests
};

std::vector<pt_device_info> list_devices();

// Implements the functions of pt_context, with the same rules for failures. While samples are running, only poll(),
// cancel() and const methods may be called.
class Renderer {
public:
    explicit Renderer(const CreateSettings &settings);

    const Log &log() const { return instance_.log(); }
    const pt_device_info &device() const { return devices_.front()->device().info(); }

    std::uint32_t width() const { return settings_ ? settings_->width : 0; }
    std::uint32_t row_count() const { return settings_ ? settings_->row_count : 0; }

    bool is_on_lent_device() const { return devices_.front()->device().is_borrowed(); }

    // Setters discard the samples.
    void set_scene(CheckedScene scene, WorkProgress &progress);
    void set_camera(const Camera &camera);
    void set_render(const RenderSettings &settings);

    // Discards the samples if a kernel has changed.
    void reload_shaders();

    // If one driver refuses the code, no device uses it.
    void set_code(const KernelCode &code);

    void prepare();

    pt_result accumulate(const pt_accumulate_info &wanted);

    // Returns PT_PENDING if samples are running, or PT_TARGET_REACHED.
    pt_result start(const pt_accumulate_info &wanted);

    struct Advance {
        pt_result result;
        double fraction;
    };

    // After an exception no samples are running.
    Advance poll(std::uint64_t nanoseconds);

    // Returns false if no samples are running. Thread-safe.
    bool cancel() noexcept { return cancellation_.ask(); }
    static constexpr const char *nothing_under_way = "no samples are under way: call pt_start first";

    bool is_under_way() const { return job_ != nullptr; }

    void readback(const Image &image);
    void readback(const BufferImage &image);

    // The image has no gaps. The memory is valid until the next call of map(), set_render() or reload_shaders().
    std::span<std::byte> map(const ImageLayout &layout);

    FilmHeader film_header();
    void save_film(const FilmHeader &header, std::span<std::byte> bytes) const; // `bytes` must have FilmLayout's size
    void add_film(std::span<const std::byte> bytes);

    pt_stats stats();

    // See displacement.h. NULL if there is no warning. Valid until the next call.
    const BrokenRule *warning();

    // Includes the error from lamps in view with too few samples.
    ErrorEstimate error_with_lamps();

    std::vector<pt_function_accuracy> accuracy();

private:
    struct Job {
        Stopping stopping;
        MostSamples counts;
        std::uint64_t together_to;        // up to this count all tiles have equal samples
        bool is_together;                 // true below together_to
        std::vector<std::uint64_t> goals; // goals of tiles, if no error is checked
        Accumulation accumulation;
    };

    void use_own_devices(const CreateSettings &settings);
    void use_device_of(const vulkan::CallerVulkan &caller, const CreateSettings &settings);
    void add_device(const vk::raii::PhysicalDevice &physical_device, const CreateSettings &settings,
                    const vulkan::CallerVulkan *caller = nullptr);
    bool is_alive() const;
    void require_alive() const;
    void require_settings() const;
    void require_samples() const;
    void require_samples_of(std::uint32_t quantity) const;
    void require_room_for(std::uint32_t sample_count) const;
    void discard_samples() noexcept;
    const std::shared_ptr<const View> &view();
    Camera ray_start();
    ImageQuery query(const ImageLayout &layout) const;
    FilmIdentity identity() const;
    Rectangle pixels() const;
    const ErrorEstimate &error();
    void look(std::span<double> by_tile, bool is_recorded);
    const std::vector<double> &tile_squares();
    bool is_on_target();
    const std::vector<LampPiece> &small_lamps();
    const std::vector<std::uint64_t> &samples_for_lamps();
    std::uint64_t adaptive_from() const;
    void require_tiles(const pt_accumulate_info &wanted) const;
    void begin(const pt_accumulate_info &wanted, bool is_polled);
    void make_job(const pt_accumulate_info &wanted, bool is_polled);
    void end_job() noexcept;
    Advance go_on(std::uint64_t nanoseconds);
    pt_result advance(Accumulation::Clock::time_point until);
    std::optional<pt_result> next_step();
    std::optional<pt_result> next_step_together();
    void take_over(TileSamples samples) noexcept;
    void forget_error() noexcept;
    void give_up() noexcept;

    ShaderSource source_;
    KernelCode code_;
    vulkan::Instance instance_;
    std::optional<std::uint32_t> tree_from_;
    RenderDevices devices_;
    FilmView film_view_{devices_};
    std::optional<PreparedScene> scene_;
    std::optional<Camera> camera_;
    std::optional<RenderSettings> settings_; // if set, the devices have films
    std::shared_ptr<const View> view_;       // NULL after a change of scene, camera or settings
    TileSamples samples_;
    AdaptiveRound round_;
    std::optional<ErrorEstimate> error_;
    std::optional<std::uint64_t> rejected_samples_;
    std::vector<std::uint64_t> samples_for_lamps_;
    std::vector<double> tile_squares_;
    std::vector<std::byte> mapped_image_;
    std::optional<std::vector<LampPiece>> small_lamps_;
    std::optional<BrokenRule> warning_;
    DeviceWork work_;
    Cancellation cancellation_;
    std::unique_ptr<Job> job_; // NULL if nothing is running
};

} // namespace pt
