// Reads what camera rays meet first (shaders/first_hit.comp): depth, normal, albedo and surfaces of the scene that is
// set, whether there are samples of it or not. Owned by RenderDevice, once it has been asked for.
#pragma once

#include "lib/film/film_header.h"
#include "lib/kernel/pixel_results.h"
#include "lib/kernel/scene_kernel.h"

#include <cstdint>
#include <functional>
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

    // Calls receive(bytes) for consecutive pieces of the pixels, row by row. Objects come as the numbers by which
    // kernels know surfaces. tests_per_submission: how many tests of rays against surfaces one submission should take.
    // Throws PT_ERROR_SHADER if the driver refuses the kernel, PT_ERROR_INTERNAL if it lost work.
    using Receive = std::function<void(std::span<const std::byte>)>;
    void read(const BoundScene &bound, const FirstHitQuery &query, double tests_per_submission, const Receive &receive);

private:
    vulkan::Device &device_;
    SceneKernel kernel_;
    std::optional<PixelResults> results_;
};

} // namespace pt
