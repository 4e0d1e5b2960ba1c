#include "cli/course/step_parts.h"
#include "cli/course/step_values.h"

namespace cli {
namespace {

constexpr std::uint32_t side = 64;
constexpr std::uint32_t samples = 64;

// Ranges of a variance, relative to the variance of random numbers. If pixel values are normally distributed, their
// variance has the relative standard deviation sqrt(2 / pixels). The quotient of two such variances has
// 2 / sqrt(pixels) = 2 / side. Ranges stay two bounds away from 1, and from `samples`, the variance if all samples are
// equal. With N samples the variance of random numbers falls as 1 / N. For functions with edges, the variance of
// Halton's points falls more slowly than 1 / N^3.
constexpr double apart = 1.0 + 2.0 * standard_errors * 2.0 / side;
constexpr Range better_than_random{1.0 / (samples * samples), 1.0 / apart};
constexpr Range worse_than_random{apart, samples / apart};

} // namespace

std::vector<Measured> measure_numbers(CourseKernels &kernels) {
    SceneFile scene = lamps_above_a_floor(side, samples);
    const Picture random = kernels.edited(scene);
    scene.render.sampler = PT_SAMPLER_HALTON_CP;
    const Picture shifted = kernels.edited(scene);
    scene.render.sampler = PT_SAMPLER_HALTON;
    const Picture unshifted = kernels.edited(scene);
    std::vector<Measured> measured = means(shifted, "shifted points, five lamps");
    measured.push_back(variance_beside("their variance beside random numbers", shifted, random));
    measured.push_back(variance_beside("the same without the shift", unshifted, random));
    return measured;
}

std::vector<Pattern> number_patterns() {
    const Channels right = right_lamplight();
    const auto values = [&](Range shifted_variance, Range unshifted_variance) {
        return joined(exact(right), {shifted_variance, unshifted_variance});
    };
    const char *equal_numbers = "equal numbers in all dimensions";
    const char *own_base = "Each number of a sample needs its own base.";
    std::vector<Pattern> patterns{
        {"", "", values(better_than_random, exactly(0.0))},
        {"numbers are still random", "The sampler halton-cp must return Halton's points.",
         values(exactly(1.0), any_value)},
        {"the sampler halton is still random", "The sampler halton must return Halton's points, without a shift.",
         values(better_than_random, exactly(1.0))},
        {"the sampler halton is shifted too", "The sampler halton has the same points in all pixels.",
         values(better_than_random, better_than_random)},
        {"pixel shift missing", "Add a random number of the pixel and the dimension, modulo 1.",
         joined(any_values(3), {exactly(0.0), any_value})},
        {"integer division", "1 / base is 0 for integers, so all samples of a pixel have the same numbers.",
         joined(any_values(3), {exactly(samples), any_value})},
        {equal_numbers, own_base, joined(any_values(3), {worse_than_random, any_value})}};
    for (const double first : {1.0, -1.0})
        patterns.push_back(
            {equal_numbers, own_base, joined(near(lamplight_of_equal_numbers(first, -first)), any_values(2))});
    return patterns;
}

} // namespace cli
