#include "cli/course/step_parts.h"
#include "cli/course/step_values.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>

namespace cli {
namespace {

// With is_diagonal both coordinates are equal.
std::vector<DiscSample> places(double scale, double offset, bool is_diagonal = false, int times = 1) {
    const int side = times > 1 ? 8 : 16;
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
    std::vector<Measured> measured = disc_values(kernels.edited(disc(true)));
    SceneFile scene = ball_before_camera_and_lamp();
    scene.render.estimator = PT_ESTIMATOR_LIGHT;
    const Picture picture = kernels.edited(scene);
    std::ranges::move(means(picture, "floor under a moving ball"), std::back_inserter(measured));
    measured.push_back(picture.relative_deviation("its deviation between pixels, green", 1));
    return measured;
}

std::vector<Measured> measure_moving_normals(CourseKernels &kernels) {
    SceneFile scene = moving_ball_under_the_sky();
    scene.render.estimator = PT_ESTIMATOR_LIGHT;
    return {kernels.edited(scene).mean("moving ball under a sky", 0)};
}

std::vector<Pattern> motion_patterns() {
    const std::vector<DiscSample> samples = places(1.0, 0.0, false, 16);
    const auto timed = [&](const std::function<double(const DiscSample &)> &time) {
        std::vector<DiscSample> changed = samples;
        for (DiscSample &sample : changed)
            sample.time = time(sample);
        return disc_values(true, changed);
    };
    const auto at = [&](double scale, double offset) {
        return timed([=](const DiscSample &sample) { return scale * sample.time + offset; });
    };
    const char *own_number = "Each sample draws a number of its own for the time.";
    const Values right = at(1.0, 0.0);
    const FloorLight light = light_below_the_ball();
    const Range green = nearly(light.right[1]);
    // Green light has the relative deviation sqrt(2) with one time a pixel, an eighth with 64.
    const Range own_times{0.0, 0.7};
    const Range moving{20.0, infinity}; // softness
    const auto disc = [](const char *name, const char *hint, const Values &values, Range deviation = any_value) {
        return Pattern{name, hint, joined(values, {any_value, any_value, any_value, deviation, any_value})};
    };
    const auto outside = [&](Range middle, Range spread) {
        return disc("time outside [0, 1)", "The shutter opens at time 0 and closes at 1.",
                    {middle, any_value, moving, any_value, spread}, own_times);
    };
    const auto floor = [&](const char *name, const Values &values) {
        return Pattern{name, "All rays of a path, to lamps too, have the time of its sample.",
                       joined(right, joined(values, {own_times, any_value}))};
    };
    const auto below_sky = [&](const char *name, const char *hint, Range ball) {
        return Pattern{name, hint, joined(right, joined(near(light.right), {own_times, ball}))};
    };
    return {below_sky("", "", nearly(1.0)),
            below_sky("normals at another time", "A normal points from the ball's center at the sample's time.",
                      {0.0, 0.99}),
            disc("nothing moves", "Use the spheres' positions at the sample's time.", at(0.0, 0.0)),
            disc("one time for all samples", own_number, at(0.0, 0.5)),
            disc("one time for each pixel", own_number, any_values(5), {1.0, infinity}),
            disc("time equal to another number", own_number, timed([](const DiscSample &s) { return s.place.x; })),
            disc("time equal to another number", own_number, timed([](const DiscSample &s) { return s.place.y; })),
            disc("time outside [0, 1)", "The shutter opens at time 0 and closes at 1.", at(1.0, -0.5)),
            outside({at(1.0, 0.2)[0].least, infinity}, any_value),
            outside(any_value, {at(1.5, -0.25)[4].least, infinity}),
            floor("shadow rays at time 0", {nearly(light.reflected_at_0[0]), green, any_value}),
            floor("reflected rays at time 0", {any_value, nearly(light.reflected_at_0[1]), any_value}),
            floor("a new time for each ray", {any_value, nearly(light.reflected_at_any_time[1]), any_value}),
            floor("a new time for each ray", {nearly(light.reflected_at_any_time[0]), green, any_value}),
            floor("cones of lamps at another time", {exactly(0.0), green, {0.0, light.right[2]}})};
}

} // namespace cli
