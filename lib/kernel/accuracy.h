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
    std::span<const float> places; // points where the formula or the result's exponent changes
};

std::span<const ElementaryFunction> elementary_functions();

// Returns the ends of the range, `places` and their neighbors. Half of the other arguments are evenly spread over the
// range, half over the exponents.
constexpr std::uint32_t arguments_per_function = 16384;
std::vector<float> accuracy_arguments(const ElementaryFunction &function);

// Infinite if `value` is NaN or infinite, or if only `exact` is 0.
double error_in_ulp(float value, double exact);

// Values that the kernel did not write are NaN. Throws PT_ERROR_INTERNAL if it writes beyond the values.
std::vector<float> evaluate(vulkan::Device &device, std::span<const std::uint32_t> spirv,
                            std::span<const float> arguments);

pt_function_accuracy compare(const ElementaryFunction &function, std::span<const float> arguments,
                             std::span<const float> values);

std::vector<pt_function_accuracy> measured_accuracy(vulkan::Device &device, std::span<const std::uint32_t> spirv);

} // namespace pt
