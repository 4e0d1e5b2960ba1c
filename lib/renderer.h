// The loop from settings to exact sums: specialise, dispatch slices, read back. One per pt_context, called by api.cpp.
#pragma once

#include "camera.h"
#include "error_estimate.h"
#include "film.h"
#include "image.h"
#include "kernel.h"
#include "log.h"
#include "render_settings.h"
#include "scene.h"
#include "schedule.h"
#include "trace_pipelines.h"
#include "vulkan/device.h"
#include "vulkan/instance.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pt {

// pt_create_info, checked, with its defaults applied.
struct CreateSettings {
    bool validation = false;
    std::string device; // empty: the best
    Log log;
    std::uint32_t submit_milliseconds = 50;
};

// The caller's pt_progress_fn.
struct Progress {
    pt_progress_fn function; // may be NULL
    void *user;
};

// All Vulkan devices of this machine.
std::vector<pt_device_info> list_devices();

// Methods throw pt::Error. A failed one has changed nothing, except that a lost device stays lost.
class Renderer {
public:
    explicit Renderer(const CreateSettings &settings);

    const pt_device_info &device() const { return device_.info(); }
    std::uint32_t width() const { return settings_ ? settings_->width : 0; }
    std::uint32_t height() const { return settings_ ? settings_->height : 0; }

    // Each setter discards the samples so far.
    void set_scene(Scene scene);
    void set_camera(const Camera &camera);
    void set_render(const RenderSettings &settings);

    // PT_OK, PT_CANCELLED or PT_TARGET_REACHED.
    pt_result accumulate(std::uint32_t sample_count, double target_error, const Progress &progress);

    void readback(const Image &image);

    // Without the error its fields say that nothing is known.
    pt_stats stats(bool with_error);

    // Of the kernel's elementary functions; leaves the samples alone.
    std::vector<pt_function_accuracy> accuracy();

private:
    void discard_samples();
    void require_settings() const;
    void prepare_kernel();
    double run(const Slice &slice);
    void advance(const Slice &slice);
    HalfCounts half_counts() const;
    const ErrorEstimate &error();
    bool is_on_target(double target_error);

    Log log_;
    vulkan::Instance instance_;
    vulkan::Device device_;
    TracePipelines pipelines_;
    double target_seconds_;
    std::optional<Scene> scene_;
    std::optional<Camera> camera_;
    std::optional<RenderSettings> settings_;
    std::optional<Film> film_;
    std::optional<Kernel> kernel_;       // empty after a setter
    std::optional<Schedule> schedule_;   // of the kernel
    std::uint32_t samples_done_ = 0;     // whole samples in every pixel
    std::uint32_t pass_pixels_done_ = 0; // of the split pass under way
    std::optional<ErrorEstimate> error_; // of the whole samples, once it has been asked for
    std::uint64_t submit_count_ = 0;
    double device_seconds_ = 0.0;
};

} // namespace pt
