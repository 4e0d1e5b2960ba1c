#include "lib/render/render_device.h"
#include "tests/kernel/coursework_view.h"
#include "tests/support/coursework_scene.h"
#include "tests/vulkan/device_fixture.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>

namespace {

constexpr std::uint32_t part_width = 15;
constexpr std::uint32_t part_height = 17;

class RenderDeviceTest : public VulkanFixture {
protected:
    pt::RenderDevice ready_device(double target_seconds) {
        return ready_device(target_seconds, pt::vulkan::default_policy(pt::vulkan::describe(physical_device())));
    }

    pt::RenderDevice ready_device(double target_seconds, const pt::vulkan::DevicePolicy &policy) {
        return pt::RenderDevice(instance(), physical_device(), policy, pt::embedded_code(), target_seconds);
    }

    static void set_up(pt::RenderDevice &device) {
        const pt::RenderSettings settings = pt::validated_render(render_of(part_width, part_height, 3));
        device.set_film(device.make_film(settings));
        device.prepare(coursework_view(settings), settings);
    }

    static pt::PixelSums sums(pt::RenderDevice &device) {
        pt::DeviceFilm &film = device.film();
        pt::PixelSums sums;
        sums.resize(film.pixel_count());
        film.read(0, sums);
        return sums;
    }

    static void take(pt::RenderDevice &device, std::span<const std::uint32_t> tiles, const pt::SampleRange &before,
                     const pt::SampleRange &samples) {
        device.start({tiles, before, samples, true});
        EXPECT_EQ(device.finish().tile_samples, tiles.size() * samples.count());
    }
};

constexpr std::array<std::uint32_t, 6> all_tiles = {0, 1, 2, 3, 4, 5};

std::array<double, 6> sums_of_tiles(const std::function<void(const pt::ErrorReader::Receive &)> &read) {
    std::array<double, 6> sums{};
    read([&](const pt::TileErrors &tiles) {
        sums[0] += tiles.square.sum;
        sums[1] += tiles.square.of_pixels;
        sums[2] += tiles.relative_square.sum;
        sums[3] += tiles.relative_square.of_tiles;
        sums[4] += tiles.unseen;
        sums[5] += tiles.value_count;
    });
    return sums;
}

TEST_F(RenderDeviceTest, AnErrorBehindItsSamplesIsThatOfTheFilm) {
    pt::RenderDevice device = ready_device(60.0, pt::vulkan::gpu_like_policy());
    set_up(device);
    ASSERT_TRUE(device.estimates_behind());
    pt::TileSamples taken(device.film().grid());
    std::array<double, 6> last{};
    for (const pt::SampleRange range : {pt::SampleRange{100, 116}, {116, 120}, {120, 128}, {40, 60}, {128, 140}}) {
        const pt::SampleRange before = taken.of(0).hull();
        taken.add(all_tiles, range);
        const pt::ErrorQuery query{1.0, taken};
        device.start({all_tiles, before, range, true}, &query);
        device.finish();
        pt::ErrorReader &reader = device.error_reader();
        const std::array<double, 6> found = sums_of_tiles([&](const auto &take) { reader.collect(query, take); });
        EXPECT_EQ(found, sums_of_tiles([&](const auto &take) { reader.read(query, take); })) << pt::text_of(range);
        EXPECT_NE(found, last);
        last = found;
    }
}

} // namespace
