#pragma once

#include "lib/vulkan/device.h"

#include <pt/accuracy.h>
#include <pt/pt.h>

#include <cstdint>
#include <span>
#include <vector>

namespace pt {

struct ElementaryFunction {
    const char *name;
    double (*exact)(double);
    double bound;
    float first, last;
    std::span<const float> places; // points where the function switches formulas
};

std::span<const ElementaryFunction> elementary_functions();

// The arguments are the ends of the range, `places` and their neighbors, and others: half of these are evenly spread
// over the range, half over its exponents.
constexpr std::uint32_t arguments_per_function = 16384;
std::vector<float> accuracy_arguments(const ElementaryFunction &function);

// An ulp of `exact` is 2^(e - 23) for 2^e <= |exact| < 2^(e + 1). NaN and infinity have an infinite error. So does a
// value that is not 0 if `exact` is 0.
double error_in_ulp(float value, double exact);

// Unwritten values are NaN. Throws PT_ERROR_INTERNAL if the kernel writes past its values.
std::vector<float> evaluate(vulkan::Device &device, std::span<const std::uint32_t> spirv,
                            std::span<const float> arguments);

pt_function_accuracy compare(const ElementaryFunction &function, std::span<const float> arguments,
                             std::span<const float> values);

std::vector<pt_function_accuracy> measured_accuracy(vulkan::Device &device, std::span<const std::uint32_t> spirv);

} // namespace pt
