#include "lib/kernel/device_film.h"
#include "lib/kernel/kernel.h"
#include "lib/kernel/trace_pipelines.h"
#include "tests/kernel/coursework_gpu_scene.h"
#include "tests/support/coursework_scene.h"
#include "tests/vulkan/device_fixture.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace {

constexpr std::uint32_t kernel_width = 50;
constexpr std::uint32_t kernel_height = 21;

class KernelTest : public VulkanFixture {
protected:
    std::vector<pt::PixelSums> film_sums(std::uint32_t invocations, const std::vector<std::uint32_t> &sample_counts) {
        pt::vulkan::Device &device = device_with({.patience = std::chrono::hours{1},
                                                  .share_memory = true,
                                                  .scene_in_constants = false,
                                                  .invocations = invocations,
                                                  .queue_depth = 1});
        pt::TracePipelines pipelines(device);
        pt::DeviceFilm film(device, kernel_width, kernel_height, pt::max_strip_pixels(device.limits()));
        const pt::RenderSettings settings = pt::validated_render(render_of(kernel_width, kernel_height, 3));
        pt::Kernel kernel(device, pipelines, film, nullptr, coursework_gpu_scene(settings), settings);
        std::vector<std::uint32_t> tiles(film.grid().count());
        std::iota(tiles.begin(), tiles.end(), 0U);
        std::vector<pt::PixelSums> all;
        for (const std::uint32_t sample_count : sample_counts) {
            device.submit([&](const vk::raii::CommandBuffer &commands) { film.clear(commands); });
            kernel.finish(kernel.start({tiles, {}, {5, std::uint64_t{5} + sample_count}, true}, false));
            pt::PixelSums &sums = all.emplace_back();
            sums.resize(film.pixel_count());
            film.read(0, sums);
        }
        return all;
    }
};

TEST_F(KernelTest, InvocationsThatShareAPixelGiveTheBitsOfOne) {
    const std::vector<std::uint32_t> sample_counts{1, 5, 36, 37, 200};
    const std::vector<pt::PixelSums> shared = film_sums(1U << 18, sample_counts);
    const std::vector<pt::PixelSums> alone = film_sums(0, sample_counts);
    for (std::size_t i = 0; i < sample_counts.size(); ++i)
        EXPECT_TRUE(shared[i] == alone[i]) << sample_counts[i] << " samples";
    EXPECT_FALSE(shared[2] == alone[3]) << "a missing sample must show";
}

} // namespace
