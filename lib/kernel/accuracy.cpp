#include "lib/kernel/accuracy.h"

#include "lib/base/error.h"
#include "lib/code/specialised_pipeline.h"
#include "lib/vulkan/buffer.h"
#include "lib/vulkan/compute_pipeline.h"
#include "shaders/specialization.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

namespace pt {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr double float_pi = 3.14159274101257324;

// Reduces the argument to a quarter turn, so that zeros are exact.
double sine_of_turn(double u) {
    if (u > 0.5)
        return -sine_of_turn(u - 0.5);
    return std::sin(full_turn * std::min(u, 0.5 - u));
}

double cosine_of_turn(double u) {
    return std::sin(full_turn * (0.25 - std::min(u, 1.0 - u)));
}

constexpr float turns[] = {0.125F, 0.25F, 0.375F, 0.5F, 0.625F, 0.75F, 0.875F};
constexpr float complements[] = {0.0625F, 0.25F, 0.5F, 0.75F, 0.875F, 0.999F};
constexpr float exponents[] = {-0.5F, -1.0F, -1.5F, -24.5F, -99.5F};
constexpr float powers_of_two[] = {1.0F, 2.0F, 4.0F};

// Relative errors are in units of 2^-24. An ulp is at least one unit of the value, so errors of k units before the last
// operation are at most k ulp of the result. Rounding the result adds half an ulp. Sums and products have an error of 1
// unit. Vulkan allows 2.5 ulp for division and 2 ulp for inversesqrt ("Precision and Operation of SPIR-V
// Instructions").
constexpr ElementaryFunction functions[] = {
    // Errors of the sine: 1 from 1/2 - u, 1 from the product with m, 1.95 from q. Errors of the cosine, largest near 1
    // where p = 4: 0.5 from w^2, 1 from the last sum of p, 1.2 from the factor of w^2 in this sum, 0.9 from the rounded
    // constant, 0.1 from the approximation.
    {"sine (sin_cos_turn)", sine_of_turn, 4.5, 0x1p-100F, 1.0F, turns},
    {"cosine (sin_cos_turn)", cosine_of_turn, 4.5, 0x1p-100F, 1.0F, turns},
    // Errors of the polynomial: 0.7 from the last sum, 0.2 from the rounded constant, 0.4 from the rest. From y = 1/4
    // on, Vulkan allows log2 an error of 2^-21. At 1/4, where an ulp is 2^-25, this is 16 ulp, and the rounding of 1 -
    // y adds 2 ulp.
    {"log2(1 - x) (log2_one_minus)", [](double x) { return std::log1p(-x) / std::numbers::ln2; }, 18.0, 0x1p-100F,
     0x1.fffffep-1F, complements},
    // Vulkan allows 3 + 2 |x| ulp.
    {"2^x (exp2_negative)", [](double x) { return std::exp2(x); }, 203.0, -0x1p-100F, -100.0F, exponents},
    // Errors of e = r (0.69 + w): 0.9 from the sum, 0.1 from the rounded constant, 0.4 from w, 0.2 from the
    // approximation. With x = k + r (one_minus_exp2() in maths.glsl), the result for k = 0 is -e. For k = -1 the error
    // is at most 1.6 ulp, at r = 1/2.
    {"1 - 2^x (one_minus_exp2)", [](double x) { return -std::expm1(x * std::numbers::ln2); }, 2.5, -0x1p-100F, -100.0F,
     exponents},
    // Vulkan allows sqrt the error of 1 / inversesqrt: 4 units from inversesqrt and 2.5 ulp from the division.
    {"pi / x (division)", [](double x) { return float_pi / x; }, 2.5, 0x1p-100F, 0x1p100F, powers_of_two},
    {"square root (sqrt)", [](double x) { return std::sqrt(x); }, 6.5, 0x1p-100F, 0x1p100F, powers_of_two},
    {"1 / square root (inversesqrt)", [](double x) { return 1.0 / std::sqrt(x); }, 2.0, 0x1p-100F, 0x1p100F,
     powers_of_two},
};

// The bits of a NaN.
constexpr std::uint32_t unwritten = 0xffffffffU;
constexpr std::size_t guard_words = 64;

std::uint32_t magnitude_bits(float x) {
    return std::bit_cast<std::uint32_t>(std::abs(x));
}

} // namespace

std::span<const ElementaryFunction> elementary_functions() {
    return functions;
}

std::vector<float> accuracy_arguments(const ElementaryFunction &function) {
    const auto [small, large] = std::minmax(function.first, function.last);
    std::vector<float> arguments = {function.first, function.last};
    for (const float place : function.places) {
        const float below = std::nextafter(place, small);
        const float above = std::nextafter(place, large);
        arguments.insert(arguments.end(),
                         {std::nextafter(below, small), below, place, above, std::nextafter(above, large)});
    }
    // Multiples of the golden ratio modulo 1 are spread evenly (Weyl 1916).
    constexpr std::uint32_t golden_ratio = 0x9e3779b9U;
    const std::uint32_t first_bits = magnitude_bits(function.first);
    const std::uint64_t bits_range = magnitude_bits(function.last) - first_bits;
    for (std::uint32_t i = 1; arguments.size() < arguments_per_function; ++i) {
        const std::uint32_t share = i * golden_ratio;
        const auto by_exponent = first_bits + static_cast<std::uint32_t>(bits_range * share >> 32);
        const float even = function.first + (function.last - function.first) * (static_cast<float>(share) * 0x1p-32F);
        arguments.push_back(i % 2 == 0 ? even : std::copysign(std::bit_cast<float>(by_exponent), function.last));
    }
    return arguments;
}

double error_in_ulp(float value, double exact) {
    const double error = std::abs(double{value} - exact);
    if (error == 0.0)
        return 0.0;
    const double ulps = std::ldexp(error, 23 - std::ilogb(exact == 0.0 ? std::numeric_limits<float>::min() : exact));
    return std::isfinite(value) && exact != 0.0 ? ulps : std::numeric_limits<double>::infinity();
}

std::vector<float> evaluate(vulkan::Device &device, std::span<const std::uint32_t> spirv,
                            std::span<const float> arguments) {
    constexpr vulkan::Binding bindings[] = {{0}, {1}};
    static_assert(arguments_per_function % gpu::WORKGROUP_SIZE == 0);
    std::vector<std::uint32_t> words(arguments.size() + guard_words, unwritten);

    std::array<std::uint32_t, gpu::CONSTANT_COUNT> constants{};
    set_device_constants(constants, device);
    const vulkan::ComputePipeline pipeline(device, spirv, bindings, sizeof arguments_per_function, constants);
    vulkan::Buffer input(device, vulkan::BufferUse::Storage, arguments.size_bytes(), "arguments of functions");
    vulkan::Buffer output(device, vulkan::BufferUse::Storage, words.size() * sizeof(std::uint32_t),
                          "values of functions");
    input.upload(std::as_bytes(arguments), 0);
    output.upload(std::as_bytes(std::span(words)), 0);
    const vulkan::DescriptorSet set = pipeline.bind(std::array<vulkan::BufferRange, 2>{input, output});
    device.submit([&](const vk::raii::CommandBuffer &commands) {
        pipeline.dispatch(commands, set, std::as_bytes(std::span(&arguments_per_function, 1)),
                          static_cast<std::uint32_t>(arguments.size() / gpu::WORKGROUP_SIZE));
    });
    output.download(std::as_writable_bytes(std::span(words)), 0);

    const auto guard = words.end() - static_cast<std::ptrdiff_t>(guard_words);
    if (std::any_of(guard, words.end(), [](std::uint32_t word) { return word != unwritten; }))
        throw Error(PT_ERROR_INTERNAL, "measuring the accuracy: the kernel wrote past its values");
    std::vector<float> values(arguments.size());
    std::memcpy(values.data(), words.data(), values.size() * sizeof(float));
    return values;
}

pt_function_accuracy compare(const ElementaryFunction &function, std::span<const float> arguments,
                             std::span<const float> values) {
    pt_function_accuracy row{};
    std::strncpy(row.name, function.name, sizeof row.name - 1);
    row.bound = function.bound;
    row.worst_error = -1.0;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const double error = error_in_ulp(values[i], function.exact(double{arguments[i]}));
        if (error > row.worst_error) {
            row.worst_error = error;
            row.worst_input = double{arguments[i]};
        }
    }
    return row;
}

std::vector<pt_function_accuracy> measured_accuracy(vulkan::Device &device, std::span<const std::uint32_t> spirv) {
    std::vector<float> arguments;
    for (const ElementaryFunction &function : functions) {
        const std::vector<float> of_function = accuracy_arguments(function);
        arguments.insert(arguments.end(), of_function.begin(), of_function.end());
    }
    const std::vector<float> values = evaluate(device, spirv, arguments);

    std::vector<pt_function_accuracy> rows;
    for (std::size_t i = 0; i < std::size(functions); ++i) {
        const std::size_t first = i * arguments_per_function;
        rows.push_back(compare(functions[i], std::span(arguments).subspan(first, arguments_per_function),
                               std::span(values).subspan(first, arguments_per_function)));
    }
    return rows;
}

} // namespace pt
