// The measured accuracy of the kernel's elementary functions on a device, against double precision.
#pragma once

#include "lib/vulkan/device.h"

#include <pt/accuracy.h>
#include <pt/pt.h>

#include <cstdint>
#include <span>
#include <vector>

namespace pt {

// A function of one argument as shaders/accuracy.comp evaluates it.
struct ElementaryFunction {
    const char *name;
    double (*exact)(double);
    double bound;                  // on its error on every device that conforms to Vulkan, in ulp of the exact value
    float first, last;             // its arguments lie between the two, which have the same sign; |last| > |first|
    std::span<const float> places; // where its evaluation switches to another formula
};

std::span<const ElementaryFunction> elementary_functions();

// Number of arguments for each function, always the same ones: both ends of its range, its special places and their
// neighbours, then numbers spread evenly, half of them over the range and half over its exponents.
constexpr std::uint32_t arguments_per_function = 16384;
std::vector<float> accuracy_arguments(const ElementaryFunction &function);

// Error of a float in ulp of the exact value: 2^(e - 23) for 2^e <= |exact| < 2^(e + 1). Infinite for NaN, for
// infinities, and for all but 0 where the exact value is 0.
double error_in_ulp(float value, double exact);

// Runs a kernel like shaders/accuracy.comp over the arguments of all functions, one function after the other. A value
// that it does not write comes back as NaN. Throws pt::Error, PT_ERROR_INTERNAL if it writes past its values.
std::vector<float> evaluate(vulkan::Device &device, std::span<const std::uint32_t> spirv,
                            std::span<const float> arguments);

// The largest error among the values of a function.
pt_function_accuracy compare(const ElementaryFunction &function, std::span<const float> arguments,
                             std::span<const float> values);

// One row for each of the elementary functions, as the code of shaders/accuracy.comp has them. Throws pt::Error.
std::vector<pt_function_accuracy> measured_accuracy(vulkan::Device &device, std::span<const std::uint32_t> spirv);

} // namespace pt
