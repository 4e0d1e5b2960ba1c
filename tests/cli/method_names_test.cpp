// Tests of cli/method_names.
#include "cli/base/method_names.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace {

template <std::size_t Count>
void expect_round_trip(const cli::MethodNames<Count> &methods, std::uint32_t last) {
    EXPECT_EQ(methods.names().size(), last + 1U); // pt.h counts from 0
    for (std::uint32_t value = 0; value <= last; ++value) {
        EXPECT_EQ(methods.find(methods.name(value)), value);
    }
    EXPECT_EQ(methods.find("bset"), std::nullopt);
    EXPECT_THROW(methods.name(last + 1), std::out_of_range);
}

TEST(MethodNames, EveryMethodHasAName) {
    expect_round_trip(cli::samplers, PT_SAMPLER_SOBOL);
    expect_round_trip(cli::estimators, PT_ESTIMATOR_MIS);
    EXPECT_EQ(cli::estimators.find("light"), static_cast<std::uint32_t>(PT_ESTIMATOR_LIGHT));
}

} // namespace
