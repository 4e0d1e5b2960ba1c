#pragma once

#include "lib/film/film_header.h"
#include "lib/kernel/resolved_pixels.h"
#include "lib/kernel/scene_kernel.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace pt {

constexpr bool is_of_first_hits(std::uint32_t quantity) {
    return quantity > PT_QUANTITY_SAMPLE_COUNT && quantity != PT_QUANTITY_COVERAGE;
}

struct FirstHitQuery {
    Rectangle pixels;
    std::uint32_t quantity;
    std::uint32_t format;
};

class FirstHits {
public:
    FirstHits(vulkan::Device &device, std::span<const std::uint32_t> code);

    // Passes consecutive pieces of the pixels, row by row, to receive(). Objects are the kernel's surface indices.
    using Receive = std::function<void(std::span<const std::byte>)>;
    void read(const BoundScene &bound, const FirstHitQuery &query, double tests_per_submission, const Receive &receive);

private:
    vulkan::Device &device_;
    SceneKernel kernel_;
    std::optional<ResolvedPixels> results_;
};

} // namespace pt
