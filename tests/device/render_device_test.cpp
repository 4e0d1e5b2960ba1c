// Slices of a device as Renderer asks for them: every kind of work is cut, and the film holds whole samples wherever
// the work stands still.
#include "lib/render/render_device.h"
#include "tests/device/coursework_gpu_scene.h"
#include "tests/device/vulkan_fixture.h"
#include "tests/support/coursework_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>

namespace {

constexpr std::uint32_t part_width = 15;
constexpr std::uint32_t part_height = 17;
constexpr int workgroups = 4; // the last one in part
constexpr std::uint32_t most_samples = 18;

class RenderDeviceTest : public VulkanFixture {
protected:
    pt::RenderDevice ready_device(double target_seconds) {
        return ready_device(target_seconds, pt::vulkan::default_policy(pt::vulkan::describe(physical_device())));
    }

    pt::RenderDevice ready_device(double target_seconds, const pt::vulkan::DevicePolicy &policy) {
        return pt::RenderDevice(instance(), physical_device(), pt::vulkan::LogicalDevice::create(physical_device()),
                                policy, pt::embedded_code(), target_seconds);
    }

    static void set_up(pt::RenderDevice &device) {
        const pt::RenderSettings settings = pt::validated_render(render_of(part_width, part_height, 3));
        device.set_film(device.make_film(settings));
        prepare(device);
    }

    static void prepare(pt::RenderDevice &device) {
        const pt::RenderSettings settings = pt::validated_render(render_of(part_width, part_height, 3));
        device.prepare(coursework_gpu_scene(settings), settings);
    }

    static pt::PixelSums sums(pt::RenderDevice &device) {
        pt::DeviceFilm &film = device.film();
        pt::PixelSums sums;
        sums.resize(device.pixel_count());
        film.read(0, film.parts().split(), sums);
        return sums;
    }

    // Starts a slice of the samples up to a number of them, of which so many have been begun.
    static std::uint32_t start(pt::RenderDevice &device, std::uint32_t begun, std::uint32_t end) {
        return device.start({begun, end}, {0, begun}).samples;
    }

    // The film by the number of samples in it, taken as whole ones.
    std::map<std::uint32_t, pt::PixelSums> expected_films() {
        pt::RenderDevice device = ready_device(60.0);
        set_up(device);
        std::map<std::uint32_t, pt::PixelSums> films{{0, sums(device)}};
        for (std::uint32_t taken = 0; taken < most_samples;) {
            taken += start(device, taken, taken + 1);
            device.finish();
            films[taken] = sums(device);
        }
        return films;
    }
};

// A target that no submission meets makes each as small as can be.
constexpr double no_time = 1e-9;

TEST_F(RenderDeviceTest, EmptyingTracingAndAddingAreCut) {
    pt::RenderDevice device = ready_device(no_time);
    set_up(device);
    int film_slices = 0;
    int sample_slices = 0;
    const auto run = [&](std::uint32_t sample) {
        start(device, sample, sample + 1);
        ++(device.finish().paths == 0 ? film_slices : sample_slices);
    };
    while (device.film_is_behind())
        run(0);
    EXPECT_EQ(film_slices, workgroups);
    EXPECT_EQ(sample_slices, 0);
    do
        run(0);
    while (device.pass_pixels() > 0);
    EXPECT_EQ(film_slices, workgroups);
    EXPECT_EQ(sample_slices, workgroups);
    while (device.film_is_behind())
        run(1);
    EXPECT_EQ(film_slices, 2 * workgroups);
    EXPECT_EQ(sample_slices, workgroups);
}

// The work stands still after so many slices, over and over: within the emptying of the film, within passes, within
// their addition, and that of the pass before which the film's parts are folded.
TEST_F(RenderDeviceTest, TheFilmHoldsWholeSamplesWhereverTheWorkStandsStill) {
    const std::map<std::uint32_t, pt::PixelSums> expected = expected_films();
    for (const int slices : {1, 2, 3, 5, 6, 7, 11}) {
        pt::RenderDevice device = ready_device(no_time);
        set_up(device);
        std::uint32_t begun = 0;
        while (begun < most_samples || device.pass_pixels() > 0) {
            for (int i = 0; i < slices; ++i) {
                if (begun == most_samples && device.pass_pixels() == 0)
                    break;
                begun += start(device, begun, most_samples);
                device.finish();
            }
            const std::uint32_t whole = begun - (device.pass_pixels() > 0 ? 1 : 0);
            ASSERT_TRUE(sums(device) == expected.at(whole)) << whole << " samples, " << slices << " slices at a time";
        }
    }
    EXPECT_FALSE(expected.at(most_samples) == expected.at(most_samples - 1)) << "a missing sample must show";
}

// The sums of what the film's regions say, in their order: another film has others.
std::array<double, 6> sums_of_regions(const std::function<void(const pt::ErrorReader::Receive &)> &read) {
    std::array<double, 6> sums{};
    read([&](const pt::RegionErrors &region) {
        sums[0] += region.square.sum;
        sums[1] += region.square.of_pixels;
        sums[2] += region.relative_square.sum;
        sums[3] += region.relative_square.of_tiles;
        sums[4] += region.unseen;
        sums[5] += region.value_count;
    });
    return sums;
}

// Over samples that move the split of the film's parts, up or down, and samples that do not.
TEST_F(RenderDeviceTest, AnErrorBehindItsSamplesIsThatOfTheFilm) {
    pt::RenderDevice device = ready_device(60.0, pt::vulkan::gpu_like_policy());
    set_up(device);
    pt::SampleSet taken;
    std::array<double, 6> last{};
    for (const pt::SampleRange range : {pt::SampleRange{100, 116}, {116, 120}, {120, 128}, {40, 60}, {128, 140}}) {
        const pt::SampleRange hull = taken.hull();
        taken.add(range);
        const pt::ErrorQuery query{1.0, pt::part_counts(taken)};
        const auto [begun, estimates] = device.start(range, hull, query);
        ASSERT_EQ(begun, range.count());
        ASSERT_TRUE(estimates);
        device.finish();
        pt::ErrorReader &reader = device.error_reader();
        const std::array<double, 6> found = sums_of_regions([&](const auto &take) { reader.collect(query, take); });
        EXPECT_EQ(found, sums_of_regions([&](const auto &take) { reader.read(query, take); })) << pt::text_of(range);
        EXPECT_NE(found, last);
        last = found;
    }
}

// Neither where a slice takes fewer samples, or a part of one, nor where the host does it.
TEST_F(RenderDeviceTest, NoErrorIsEstimatedOfAnotherFilmThanThatAskedAbout) {
    const pt::ErrorQuery query{1.0, pt::part_counts(pt::SampleSet({0, 16}))};
    pt::vulkan::DevicePolicy slow = pt::vulkan::gpu_like_policy();
    slow.tests_per_second = 1.0;
    pt::vulkan::DevicePolicy by_host = pt::vulkan::gpu_like_policy();
    by_host.resolve_on_device = false;
    for (const pt::vulkan::DevicePolicy &policy : {slow, by_host}) {
        pt::RenderDevice device = ready_device(60.0, policy);
        set_up(device);
        std::uint32_t begun = 0;
        for (int i = 0; begun < 16 && i < 1000; ++i) {
            const auto [samples, estimates] = device.start({begun, 16}, {0, begun}, query);
            device.finish();
            EXPECT_TRUE(!estimates || begun + samples == 16) << begun;
            EXPECT_FALSE(estimates && !policy.resolve_on_device);
            begun += samples;
        }
        EXPECT_EQ(begun, 16U);
    }
}

// What was begun is forgotten: the film is emptied again, wherever the work stood.
TEST_F(RenderDeviceTest, DiscardedSamplesLeaveNothing) {
    const std::map<std::uint32_t, pt::PixelSums> expected = expected_films();
    pt::RenderDevice device = ready_device(no_time);
    set_up(device);
    for (const int slices : {2, workgroups + 1, 2 * workgroups + 1, 3 * workgroups + 1}) {
        std::uint32_t begun = 0;
        for (int i = 0; i < slices; ++i) {
            begun += start(device, begun, begun + 1);
            device.finish();
        }
        device.discard_samples();
        EXPECT_TRUE(sums(device) == expected.at(0)) << slices << " slices";
        prepare(device);
    }
}

} // namespace
