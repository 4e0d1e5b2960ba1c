// Reads what camera rays meet first (shaders/first_hit.comp): depth, normal, albedo and surfaces of the scene that is
// set, whether there are samples of it or not. Owned by RenderDevice, once it has been asked for.
#pragma once

#include "lib/film/film_header.h"
#include "lib/kernel/gpu_scene.h"
#include "lib/kernel/scene_kernel.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"
#include "shaders/gpu_layout.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace pt {

// Whether one of PT_QUANTITY_* is told by first hits: all but those that need samples.
constexpr bool is_of_first_hits(std::uint32_t quantity) {
    return quantity > PT_QUANTITY_SAMPLE_COUNT && quantity != PT_QUANTITY_COVERAGE;
}

struct FirstHitQuery {
    Rectangle pixels;       // of the image, at least one
    std::uint32_t quantity; // one that is_of_first_hits
    std::uint32_t format;   // PT_FORMAT_*
};

class FirstHits {
public:
    // Both arguments must outlive the object.
    FirstHits(vulkan::Device &device, std::span<const std::uint32_t> code);

    // Takes over a scene, unless it has that one already. tree: the buffer of the scene's tree, NULL if it has none; it
    // must stay until another scene is shown. Throws PT_ERROR_SHADER if the driver refuses the kernel.
    void show(const std::shared_ptr<const GpuScene> &scene, const vulkan::Buffer *tree);

    // Calls receive(bytes) for consecutive pieces of the pixels, row by row, of the scene that is shown. Objects come
    // as the numbers by which kernels know surfaces. tests_per_submission: how many tests of rays against surfaces one
    // submission should take. Throws PT_ERROR_INTERNAL if a driver lost work.
    using Receive = std::function<void(std::span<const std::byte>)>;
    void read(const FirstHitQuery &query, double tests_per_submission, const Receive &receive);

private:
    // Memory in which the device writes a piece and the host then reads it.
    struct Slot {
        vulkan::Buffer found;
        vulkan::Buffer findings;
        vulkan::Buffer host; // findings, then what has been found
        vulkan::DescriptorSet set;
    };

    std::uint64_t pixels_in_piece(const FirstHitQuery &query, double tests_per_submission) const;
    Slot &slot(std::uint64_t bytes);
    void record(const vk::raii::CommandBuffer &commands, const Slot &slot, const gpu::FirstHitConstants &constants,
                std::uint64_t bytes) const;

    vulkan::Device &device_;
    SceneKernel kernel_;
    gpu::FirstHitConstants constants_{}; // of the scene that is shown
    std::optional<Slot> slot_;
};

} // namespace pt
