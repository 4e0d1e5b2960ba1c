#include "cli/course/step_parts.h"
#include "cli/course/step_values.h"

#include <cmath>
#include <functional>
#include <numbers>

namespace cli {
namespace {

// `scale` and `offset` apply to uniform places in [0, 1). With is_diagonal both coordinates are equal.
std::vector<DiscSample> places(double scale, double offset, bool is_diagonal = false, int times = 1) {
    constexpr int side = 16;
    std::vector<DiscSample> samples;
    for (int time = 0; time < times; ++time) {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                const double across = (x + 0.5) / side;
                const double down = is_diagonal ? across : (y + 0.5) / side;
                samples.push_back({{scale * across + offset, scale * down + offset}, (time + 0.5) / times});
            }
        }
    }
    return samples;
}

} // namespace

std::vector<Measured> measure_emission(CourseKernels &kernels) {
    const Picture picture = kernels.edited(disc(false));
    const std::uint32_t middle = picture.width / 2;
    const auto color = [&](const char *name, std::size_t channel) {
        const double value = picture.at(middle, middle, channel);
        return Measured{name, value, 1e-5 * value};
    };
    // The number of pixels with their middles in the disc is within 2% of its area.
    const double share = std::numbers::pi * disc_radius * disc_radius / (picture.width * picture.height);
    const double mean = picture.mean("", 0).value;
    return {color("a lamp's emission, red", 0),
            color("a lamp's emission, green", 1),
            color("a lamp's emission, blue", 2),
            {"its disc's fraction of the picture", mean / picture.at(middle, middle, 0), 0.02 * share}};
}

std::vector<Pattern> emission_patterns() {
    const double share = std::numbers::pi * disc_radius * disc_radius / (32.0 * 32.0);
    const auto values = [&](const std::function<double(double)> &curve) {
        return Values{exactly(curve(disc_emission[0])), exactly(curve(disc_emission[1])),
                      exactly(curve(disc_emission[2])), exactly(share)};
    };
    return {{"", "", values([](double e) { return e; })},
            {"gamma twice", "Return linear radiance: the display's curve is applied to the picture later.",
             values([](double e) { return std::pow(e, 1.0 / 2.2); })},
            {"emission cut off at 1", "Lamps are brighter than white. Do not clamp.",
             values([](double e) { return std::min(e, 1.0); })},
            {"no emission",
             "Copy the emission into the material and return it.",
             {exactly(0.0), exactly(0.0), exactly(0.0), any_value}},
            {"the start",
             "Return the material's emission instead of the shape.",
             {exactly(disc_cosine()), exactly(disc_cosine()), exactly(disc_cosine()), any_value}}};
}

std::vector<Measured> measure_filter(CourseKernels &kernels) {
    return disc_values(kernels.edited(disc(false)));
}

std::vector<Pattern> filter_patterns() {
    return {{"", "", disc_values(false, places(1.0, 0.0))},
            {"no filter", "Send rays anywhere in the pixel, not only through its middle.",
             disc_values(false, places(0.0, 0.5))},
            {"half a pixel off", "Places in a pixel are from 0 to 1, not from -1/2.",
             disc_values(false, places(1.0, -0.5))},
            {"half a pixel off", "Places in a pixel are from 0 to 1, so do not add its middle.",
             disc_values(false, places(1.0, 0.5))},
            {"equal numbers in all dimensions", "The coordinates to the right and down need a number each.",
             disc_values(false, places(1.0, 0.0, true))},
            {"a box of two pixels", "Numbers in [0, 1) cover one pixel.", disc_values(false, places(2.0, -0.5))}};
}

std::vector<Measured> measure_motion(CourseKernels &kernels) {
    return disc_values(kernels.edited(disc(true)));
}

std::vector<Pattern> motion_patterns() {
    const std::vector<DiscSample> right = places(1.0, 0.0, false, 16);
    const auto at = [&](double scale, double offset) {
        std::vector<DiscSample> samples = right;
        for (DiscSample &sample : samples)
            sample.time = scale * sample.time + offset;
        return disc_values(true, samples);
    };
    return {{"", "", at(1.0, 0.0)},
            {"nothing moves", "Use the spheres' positions at the sample's time.", at(0.0, 0.0)},
            {"one time for all samples", "Each sample has its own time.", at(0.0, 0.5)},
            {"motion about the start", "The shutter opens at time 0 and closes at 1.", at(1.0, -0.5)},
            {"motion twice as far", "Times are from 0 to 1.", at(2.0, 0.0)}};
}

} // namespace cli
