// Measures the accuracy of a device's elementary functions against double precision.
#pragma once

#include "lib/vulkan/device.h"

#include <pt/accuracy.h>
#include <pt/pt.h>

#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// A function of one argument (shaders/accuracy.comp).
struct ElementaryFunction {
    const char *name;
    double (*exact)(double);
    double bound;                  // of the error, in ulp of the exact value, on every device that conforms to Vulkan
    float first, last;             // bounds of its arguments, of one sign; |last| > |first|
    std::span<const float> places; // where its evaluation switches to another formula
};

std::span<const ElementaryFunction> elementary_functions();

// Arguments per function, always the same: the ends of the range, special places and their neighbors, then numbers
// spread evenly, half of them over the range and half over its exponents.
constexpr std::uint32_t arguments_per_function = 16384;
std::vector<float> accuracy_arguments(const ElementaryFunction &function);

// In ulp of the exact value, 2^(e - 23) for 2^e <= |exact| < 2^(e + 1). Infinite for NaN, for infinities, and if only
// the exact value is 0.
double error_in_ulp(float value, double exact);

// Runs a kernel like shaders/accuracy.comp over the arguments of all functions, one function after the other. Values
// that it does not write are NaN. Throws pt::Error, PT_ERROR_INTERNAL if it writes past its values.
std::vector<float> evaluate(vulkan::Device &device, std::span<const std::uint32_t> spirv,
                            std::span<const float> arguments);

// Finds the largest error of a function.
pt_function_accuracy compare(const ElementaryFunction &function, std::span<const float> arguments,
                             std::span<const float> values);

// A row per elementary function. Throws pt::Error.
std::vector<pt_function_accuracy> measured_accuracy(vulkan::Device &device, std::span<const std::uint32_t> spirv);

} // namespace pt
