#include "tests/analytic/analytic_fixture.h"
#include "tests/analytic/crop.h"
#include "tests/analytic/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace analytic;

constexpr std::uint32_t batch_count = 16;

// Returns a power of two, because Sobol points are most even at such counts.
std::uint32_t samples_for(const Crop &crop, const cli::SceneFile &scene) {
    const double paths = (1U << 21) / samples_for_one();
    const double surfaces = static_cast<double>(scene.spheres.size() + scene.planes.size());
    const double samples = paths / (batch_count * crop.width * crop.height * (1.0 + 0.05 * surfaces));
    return std::bit_floor(static_cast<std::uint32_t>(std::clamp(samples, surfaces > 100.0 ? 2.0 : 16.0, 4096.0)));
}

struct Measurement {
    std::uint32_t sample_count;
    Estimate radiance;
};

struct Bounds {
    Bounds(const Measurement &measured, const Exact &exact) :
        tabulated(error_bound(exact.relative_std, measured.sample_count)),
        of_batches(batch_bound(measured.radiance, exact, batch_count) / exact.radiance) {}

    double tabulated;
    double of_batches;
};

bool measurement_agrees(const Measurement &measured, const Exact &exact) {
    const double difference = std::abs(measured.radiance.mean - exact.radiance);
    return agrees(measured.radiance.mean, exact, measured.sample_count) &&
           difference <= batch_bound(measured.radiance, exact, batch_count);
}

bool resolves(const Measurement &measured, const Exact &exact) {
    const Bounds bounds(measured, exact);
    return exact.radiance > 0.0 && 0.03 > 2.0 * std::min(bounds.tabulated, bounds.of_batches);
}

class PixelFixture : public AnalyticFixture {
protected:
    Batches render(const cli::SceneFile &scene, const Crop &crop, std::uint32_t samples, std::uint32_t first_row = 0,
                   std::uint32_t row_count = 0) {
        set_up(scene.scene(), cropped(scene.camera, scene.render.height, crop.height));
        pt_render settings = render_of(crop.width, crop.height, scene.render.max_path_length);
        settings.first_row = first_row;
        settings.row_count = row_count;
        return render_batches(settings, batch_count, samples);
    }

    Measurement measure(const cli::SceneFile &scene, const Pixel &pixel) {
        const Crop crop = crop_around(scene.render.width, scene.render.height, pixel.x, pixel.y);
        const std::uint32_t samples = samples_for(crop, scene);
        return {batch_count * samples, estimate_of_pixel(render(scene, crop, samples, crop.y, 1), crop.x)};
    }
};

class Analytic : public PixelFixture, public testing::WithParamInterface<Expectation> {
protected:
    // Negative control: values that are 3% wrong, and lamps that are 3% brighter.
    void expect_to_see_errors(cli::SceneFile scene, const Pixel &pixel, const Measurement &measured) {
        for (const double factor : {0.97, 1.03}) {
            const Exact wrong{pixel.exact.radiance * factor, pixel.exact.relative_std};
            EXPECT_FALSE(measurement_agrees(measured, wrong)) << pixel.x << ", " << pixel.y;
        }
        brighten(scene, 1.03F);
        EXPECT_FALSE(measurement_agrees(measure(scene, pixel), pixel.exact)) << pixel.x << ", " << pixel.y;
    }
};

TEST_P(Analytic, PixelsAreExact) {
    const Expectation &expectation = GetParam();
    const cli::SceneFile scene = read_scene(expectation.scene);
    bool sees_errors = false;
    for (const Pixel &pixel : expectation.pixels) {
        const Measurement measured = measure(scene, pixel);
        const bool exact = measurement_agrees(measured, pixel.exact);
        EXPECT_TRUE(exact) << pixel.x << ", " << pixel.y << ": " << measured.radiance.mean << " +- "
                           << measured.radiance.standard_error << ", expected " << pixel.exact.radiance;
        if (exact && !sees_errors && resolves(measured, pixel.exact)) {
            sees_errors = true;
            expect_to_see_errors(scene, pixel, measured);
        }
    }
}

std::string test_name(std::string name) {
    for (char &c : name)
        c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return "Scene" + name;
}

// Only agrees() judges here (judge.h), because the noise measured with few samples may be 0.
class WholeImage : public PixelFixture, public testing::WithParamInterface<std::string> {};

TEST_P(WholeImage, PixelsAreInTheirPlaces) {
    const cli::SceneFile scene = read_scene(GetParam());
    const Crop whole{scene.render.width, scene.render.height, 0, 0};
    const std::uint32_t paths = (1U << 22) / samples_for_one();
    const std::uint32_t samples = paths / (whole.width * whole.height * batch_count) + 1;
    const Batches batches = render(scene, whole, samples);
    int misplaced = 0; // Negative control: pixels mirrored in both axes.
    for (const Expectation &expectation : read_expectations())
        for (const Pixel &pixel : expectation.pixels) {
            if (expectation.scene != GetParam())
                continue;
            const auto agrees_at = [&](std::uint32_t x, std::uint32_t y) {
                const Estimate measured = estimate_of_pixel(batches, std::size_t{y} * whole.width + x);
                return agrees(measured.mean, pixel.exact, batch_count * samples);
            };
            EXPECT_TRUE(agrees_at(pixel.x, pixel.y)) << pixel.x << ", " << pixel.y;
            misplaced += !agrees_at(whole.width - 1 - pixel.x, pixel.y);
            misplaced += !agrees_at(pixel.x, whole.height - 1 - pixel.y);
        }
    EXPECT_GT(misplaced, 0);
}

INSTANTIATE_TEST_SUITE_P(Tabulated, Analytic, testing::ValuesIn(read_expectations()),
                         [](const auto &param) { return test_name(param.param.scene); });

INSTANTIATE_TEST_SUITE_P(Tabulated, WholeImage,
                         testing::Values("01-above", "26-edge", "27-silhouette", "30-terminator"),
                         [](const auto &param) { return test_name(param.param); });

} // namespace
