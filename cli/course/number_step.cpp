#include "cli/base/text.h"
#include "cli/course/step_parts.h"
#include "cli/course/step_values.h"
#include "cli/selftest/selftest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

namespace cli {
namespace {

constexpr std::uint32_t picture_side = 64;
constexpr std::uint32_t pixel_samples = 64;

// Two bounds away from 1, the value of random numbers. A quotient of two variances over normally distributed pixels has
// the standard deviation 2 / picture_side. For functions with edges, Halton's variance falls more slowly than 1 / N^3.
constexpr double apart = 1.0 + 2.0 * standard_errors * 2.0 / picture_side;
constexpr Range better_than_random{1.0 / (pixel_samples * pixel_samples), 1.0 / apart};
constexpr Range no_worse_than_random{better_than_random.least, 1.0};

using Numbers = std::vector<double>;

double modulo_1(double number) {
    return number - std::floor(number);
}

// Halton's points step by 1 / base modulo 1. A carry adds to a step, but never to two in succession. Returns 0 for
// other numbers.
int base_of(double first, double second, double third) {
    const double step = std::min(modulo_1(second - first), modulo_1(third - second));
    const double base = std::round(1.0 / step);
    return step >= unit_roundoff && std::abs(1.0 / step - base) < 0.01 ? static_cast<int>(base) : 0;
}

template <typename Element, typename Alike>
double pairs(const std::vector<Element> &elements, const Alike &alike) {
    double count = 0.0;
    for (std::size_t i = 0; i < elements.size(); ++i)
        count += static_cast<double>(std::count_if(elements.begin(), elements.begin() + static_cast<std::ptrdiff_t>(i),
                                                   [&](Element other) { return alike(elements[i], other); }));
    return count;
}

Picture sampled(CourseKernels &kernels, std::uint32_t sampler) {
    SceneFile scene = lamps_above_a_floor(picture_side, pixel_samples);
    scene.render.sampler = sampler;
    return kernels.edited(scene);
}

Measured variance(CourseKernels &kernels, const char *sampler, const Picture &picture) {
    return relative_variance(concat("variance x samples, ", sampler), picture, pixel_samples,
                             kernels.edited(lamps_above_a_floor(2 * picture_side, 1)));
}

} // namespace

std::vector<Measured> measure_numbers(CourseKernels &kernels) {
    const Picture shifted = sampled(kernels, PT_SAMPLER_HALTON_CP);
    std::vector<Measured> measured = means(shifted, "shifted points, five lamps");
    measured.push_back(variance(kernels, "random", sampled(kernels, PT_SAMPLER_RANDOM)));
    measured.push_back(variance(kernels, "halton-cp", shifted));
    return measured;
}

std::vector<Measured> measure_samplers(CourseKernels &kernels) {
    return {variance(kernels, "halton", sampled(kernels, PT_SAMPLER_HALTON)),
            variance(kernels, "default", sampled(kernels, PT_SAMPLER_BEST))};
}

// A pixel's first number is the shift if its point has index 0, or shift + 1 / base for index 1.
std::vector<Measured> measure_dimensions(CourseKernels &kernels) {
    constexpr std::size_t dimensions = 8;
    constexpr std::uint32_t last = 2 * 3 * 5 * 7 * 11 * 13 - 1; // its last digits are the greatest
    const auto numbers = [&](std::uint32_t sample) { return kernels.numbers(glowing_ball(4), sample); };
    const std::array<Numbers, 4> points{numbers(0), numbers(1), numbers(2), numbers(last)};
    std::vector<int> bases;
    std::array<Numbers, 2> shifts;
    double kept = 0.0;
    const std::size_t count = std::min({dimensions, points[0].size(), points[1].size(), points[2].size()});
    for (std::size_t i = 0; i < count; ++i) {
        kept += points[1][i] == points[0][i] || points[1][i] == points[2][i] ? 1.0 / static_cast<double>(count) : 0.0;
        const int base = base_of(points[0][i], points[1][i], points[2][i]);
        if (base > 0) {
            bases.push_back(base);
            shifts[0].push_back(points[0][i]);
            shifts[1].push_back(modulo_1(points[0][i] - 1.0 / base));
        }
    }
    const auto are_near = [](double a, double b) { return a > 0.0 && std::abs(a - b) < 1e-6; };
    return {{"pairs of numbers with equal bases", pairs(bases, std::equal_to<>()), 0.0},
            {"bases with a common factor", pairs(bases, [](int a, int b) { return std::gcd(a, b) > 1; }), 0.0},
            {"pairs of equal shifts", std::max(pairs(shifts[0], are_near), pairs(shifts[1], are_near)), 0.0},
            {"largest shifted number", points[3].empty() ? 0.0 : std::ranges::max(points[3]), 0.0},
            {"fraction kept in the next sample", kept, 0.0}};
}

std::vector<Pattern> number_patterns() {
    const Range some{1.0, infinity};
    const Range below_1{0.01, 1.0 - unit_roundoff};
    const auto variances = [](const char *name, const char *hint, Range random, Range shifted,
                              Range unshifted = any_value, Range other = any_value) {
        return Pattern{name, hint,
                       joined(any_values(3), joined({random, shifted}, joined(any_values(5), {unshifted, other})))};
    };
    const auto dimensions = [](const char *name, const char *hint, const Values &values) {
        return Pattern{name, hint, joined(any_values(5), joined(values, any_values(2)))};
    };
    return {
        {"", "",
         joined(exact(right_lamplight()), {exactly(1.0), better_than_random, exactly(0.0), exactly(0.0), exactly(0.0),
                                           below_1, exactly(0.0), exactly(0.0), no_worse_than_random})},
        variances("the sampler random is not random", "SAMPLER_RANDOM keeps random numbers; SAMPLER chooses.",
                  {0.0, better_than_random.most}, any_value),
        variances("numbers are still random", "The sampler halton-cp must return Halton's points.", any_value,
                  exactly(1.0)),
        variances("the sampler halton is still random",
                  "The sampler halton must return Halton's points, without a shift.", exactly(1.0), better_than_random,
                  exactly(1.0)),
        variances("the sampler halton is shifted too", "The sampler halton has the same points in all pixels.",
                  exactly(1.0), better_than_random, better_than_random),
        variances("the default sampler has no shift",
                  "Only the sampler halton has the same points in all pixels. All others are random or shifted.",
                  exactly(1.0), better_than_random, exactly(0.0), exactly(0.0)),
        variances("pixel shift missing", "Add a random number of the pixel and the dimension, modulo 1.", any_value,
                  exactly(0.0)),
        variances("integer division", "1 / base is 0 for integers, so all samples of a pixel have the same numbers.",
                  any_value, exactly(pixel_samples)),
        dimensions("equal numbers in all dimensions", "Each number of a sample needs its own base.",
                   {some, any_value, any_value, any_value, any_value}),
        dimensions("bases with a common factor", "Bases must be primes: 2, 3, 5, 7, 11 and so on.",
                   {exactly(0.0), some, any_value, any_value, any_value}),
        dimensions("one shift for all dimensions", "The shift's random number depends on pixel and dimension.",
                   {exactly(0.0), exactly(0.0), some, any_value, any_value}),
        dimensions("numbers are not traced", "next_number() must pass its numbers through traced_number().",
                   {exactly(0.0), exactly(0.0), exactly(0.0), exactly(0.0), any_value}),
        dimensions("no modulo 1", "The sum of number and shift must return to [0, 1): take fract().",
                   {exactly(0.0), exactly(0.0), any_value, {1.0 - 1e-6, infinity}, any_value}),
        dimensions("a dimension that never changes", "Bases are primes, and 1 is none: they begin with 2.",
                   {exactly(0.0), exactly(0.0), exactly(0.0), below_1, {0.1, 0.9}}),
        dimensions("two samples with one point", "The point's index is the number of the sample: each has its own.",
                   {exactly(0.0), exactly(0.0), exactly(0.0), below_1, {0.99, 1.0}})};
}

} // namespace cli
