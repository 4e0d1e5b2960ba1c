// Tests of cli/selftest_report and selftest_check.
#include "cli/selftest/selftest_command.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <limits>

namespace {

cli::SelftestReport example_selftest() {
    cli::SelftestReport report{};
    std::strcpy(report.device.name, "a device");
    std::strcpy(report.device.driver, "its driver 1.2");
    report.device.kind = PT_DEVICE_DISCRETE_GPU;
    report.device.memory_bytes = std::uint64_t{3} << 30;
    report.checks = {{"function", "sine", 2.5, 2.5, "ulp", "worst at 0.5"},
                     {"scene", "ball", 0.0, 0.0, "relative", ""}};
    return report;
}

TEST(SelftestReport, AnErrorAtItsBoundPassesAndBeyondFails) {
    cli::SelftestCheck check{"function", "sine", 2.5, 2.5, "ulp", ""};
    EXPECT_TRUE(check.passed());
    for (const double wrong : {2.5000001, std::numeric_limits<double>::infinity(), std::nan("")}) {
        check.error = wrong;
        EXPECT_FALSE(check.passed()) << wrong;
    }
}

TEST(SelftestReport, HasWhatAReportOfAFaultNeeds) {
    const std::string text = cli::selftest_text(example_selftest());
    for (const char *part : {"device  a device\n", "driver  its driver 1.2\n", "kind    discrete GPU\n",
                             "memory  3.0 GiB\n", "pass  sine ", "worst at 0.5\n", "\npassed: all 2 checks\n"}) {
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    }
    EXPECT_EQ(text.find("FAIL"), std::string::npos);
}

TEST(SelftestReport, OneFailureIsTheVerdict) {
    cli::SelftestReport report = example_selftest();
    report.checks[1].error = 1e-9;
    EXPECT_FALSE(report.passed());
    const std::string text = cli::selftest_text(report);
    EXPECT_NE(text.find("FAIL  ball "), std::string::npos) << text;
    EXPECT_TRUE(text.ends_with("\nFAILED: 1 of 2 checks\n")) << text;
}

TEST(SelftestReport, Json) {
    cli::SelftestReport report = example_selftest();
    EXPECT_EQ(cli::selftest_json(report).at("passed"), true);
    report.checks[0].error = std::numeric_limits<double>::infinity();
    const auto json = cli::selftest_json(report);
    EXPECT_EQ(json.at("passed"), false);
    EXPECT_EQ(json.at("device").at("kind"), "discrete GPU");
    EXPECT_TRUE(json.at("checks")[0].at("error").is_null());
    EXPECT_EQ(json.at("checks")[0].at("passed"), false);
    EXPECT_EQ(json.at("checks")[1].at("passed"), true);
    EXPECT_EQ(json.at("checks")[1].at("error"), 0.0);
}

} // namespace
