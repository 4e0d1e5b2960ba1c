// The kernel as Renderer runs it, on a device that is used otherwise than by default: what it adds to the film.
#include "lib/kernel/device_film.h"
#include "lib/kernel/kernel.h"
#include "lib/kernel/trace_pipelines.h"
#include "tests/device/coursework_gpu_scene.h"
#include "tests/device/vulkan_fixture.h"
#include "tests/support/coursework_scene.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <numeric>
#include <vector>

namespace {

constexpr std::uint32_t kernel_width = 50;
constexpr std::uint32_t kernel_height = 21;

class KernelTest : public VulkanFixture {
protected:
    // The film after a slice of whole samples.
    pt::PixelSums film_sums(std::uint32_t invocations, std::uint32_t sample_count) {
        pt::vulkan::Device &device = device_with({.patience = std::chrono::hours{1},
                                                  .share_memory = true,
                                                  .scene_in_constants = false,
                                                  .invocations = invocations,
                                                  .queue_depth = 1});
        pt::TracePipelines pipelines(device);
        pt::DeviceFilm film(device, kernel_width, kernel_height, pt::max_strip_pixels(device.limits()));
        device.submit([&](const vk::raii::CommandBuffer &commands) { film.clear(commands); });
        const pt::RenderSettings settings = pt::validated_render(render_of(kernel_width, kernel_height, 3));
        pt::Kernel kernel(device, pipelines, film, nullptr, coursework_gpu_scene(settings), settings);
        std::vector<std::uint32_t> tiles(film.grid().count());
        std::iota(tiles.begin(), tiles.end(), 0U);
        kernel.finish(kernel.start({tiles, {}, {5, std::uint64_t{5} + sample_count}, true}, false));
        pt::PixelSums sums;
        sums.resize(film.pixel_count());
        film.read(0, sums);
        return sums;
    }
};

// Where an image is small for a device, some invocations share a pixel's samples and add to the film at the same time.
TEST_F(KernelTest, InvocationsThatShareAPixelGiveTheBitsOfOne) {
    for (const std::uint32_t sample_count : {1U, 5U, 37U, 200U})
        EXPECT_TRUE(film_sums(1U << 18, sample_count) == film_sums(0, sample_count)) << sample_count << " samples";
    EXPECT_FALSE(film_sums(1U << 18, 36) == film_sums(0, 37)) << "a missing sample must show";
}

} // namespace
