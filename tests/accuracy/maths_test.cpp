#include "lib/kernel/accuracy.h"

#include "accuracy_skips.spv.h"
#include "lib/base/error.h"
#include "lib/code/shader_source.h"
#include "shaders/gpu_layout.h"
#include "tests/accuracy/comparison.h"
#include "tests/kernel/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace accuracy::maths {

namespace {

TEST(AccuracyMaths, OfElementaryFunctions) {
    const std::vector<pt_function_accuracy> rows = pt::measured_accuracy(probe_device(), pt::embedded_code().accuracy);
    ASSERT_EQ(rows.size(), pt::elementary_functions().size());
    for (const pt_function_accuracy &row : rows) {
        std::printf("accuracy: %-28s %6u inputs, worst %8.2g of %8.2g ulp at %.9g\n", row.name,
                    pt::arguments_per_function, row.worst_error, row.bound, row.worst_input);
        EXPECT_LE(row.worst_error, row.bound) << row.name;
        EXPECT_GE(row.worst_error, 0.0) << row.name;
    }
}

// Negative control: the error of one value is slightly above the bound.
TEST(AccuracyMaths, ASingleErrorIsSeen) {
    for (const pt::ElementaryFunction &function : pt::elementary_functions()) {
        const std::vector<float> arguments = pt::accuracy_arguments(function);
        ASSERT_EQ(arguments.size(), pt::arguments_per_function);
        const auto [least, most] = std::ranges::minmax(arguments);
        EXPECT_EQ(least, std::min(function.first, function.last)) << function.name;
        EXPECT_EQ(most, std::max(function.first, function.last)) << function.name;
        std::vector<float> values;
        for (const float argument : arguments)
            values.push_back(static_cast<float>(function.exact(double{argument})));
        EXPECT_LE(pt::compare(function, arguments, values).worst_error, 0.5) << function.name;
        const std::size_t wrong = 9999;
        const int steps = static_cast<int>(function.bound) + 1;
        for (int i = 0; i < steps; ++i)
            values[wrong] = std::nextafter(values[wrong], 1e30F);
        const pt_function_accuracy row = pt::compare(function, arguments, values);
        EXPECT_GT(row.worst_error, function.bound) << function.name;
        EXPECT_LT(row.worst_error, 2.0 * (function.bound + 2.0)) << function.name; // Below 2^e, ulps are half as large.
        EXPECT_EQ(row.worst_input, double{arguments[wrong]}) << function.name;
        EXPECT_STREQ(row.name, function.name);
    }
}

// Negative control: a kernel that skips a value.
TEST(AccuracyMaths, AnUnwrittenValueIsSeen) {
    std::vector<float> arguments(4 * pt::gpu::WORKGROUP_SIZE, 1.0F);
    const std::vector<float> values = pt::evaluate(probe_device(), accuracy_skips_spirv(), arguments);
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(std::isnan(values[i]), i == 100) << i;
    const pt::ElementaryFunction identity{"identity", [](double x) { return x; }, 0.5, 1.0F, 2.0F, {}};
    EXPECT_EQ(pt::compare(identity, arguments, values).worst_error, std::numeric_limits<double>::infinity());
}

// Negative control: a kernel that writes past its values.
TEST(AccuracyMaths, ValuesBeyondTheEndAreAnError) {
    const std::vector<float> arguments(4 * pt::gpu::WORKGROUP_SIZE, 2.0F);
    try {
        pt::evaluate(probe_device(), accuracy_skips_spirv(), arguments);
        FAIL() << "nothing was thrown";
    } catch (const pt::Error &error) {
        EXPECT_EQ(error.code(), PT_ERROR_INTERNAL);
    }
}

} // namespace

} // namespace accuracy::maths
