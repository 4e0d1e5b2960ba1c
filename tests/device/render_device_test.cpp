// Slices of a device as Renderer asks for them: every kind of work is cut, and the film holds whole samples wherever the
// work stands still.
#include "lib/render/render_device.h"
#include "tests/device/coursework_gpu_scene.h"
#include "tests/device/vulkan_fixture.h"
#include "tests/support/coursework_scene.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>

namespace {

constexpr std::uint32_t part_width = 15;
constexpr std::uint32_t part_height = 17;
constexpr int workgroups = 4; // the last one in part
constexpr std::uint32_t most_samples = 18;

class RenderDeviceTest : public VulkanFixture {
protected:
    pt::RenderDevice ready_device(double target_seconds) {
        return pt::RenderDevice(instance(), physical_device(), pt::vulkan::LogicalDevice::create(physical_device()),
                                pt::vulkan::default_policy(pt::vulkan::describe(physical_device())),
                                pt::embedded_code(), target_seconds);
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
        return device.start({begun, end}, {0, begun});
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
