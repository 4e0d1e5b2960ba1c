// Tests of cli/number.
#include "cli/base/number.h"

#include <gtest/gtest.h>

#include <array>
#include <string_view>

namespace {

TEST(Number, ReadsTheWholeText) {
    EXPECT_EQ(cli::parse_number<std::uint32_t>("4294967295"), 4294967295U);
    EXPECT_EQ(cli::parse_number<std::uint64_t>("18446744073709551615"), 18446744073709551615U);
    EXPECT_EQ(cli::parse_number<std::uint32_t>("010"), 10U); // not octal
    EXPECT_EQ(cli::parse_number<double>("-1.5e1"), -15.0);
}

TEST(Number, RefusesAllElse) {
    for (const char *text : {"", " 1", "1 ", "-1", "+1", "4294967296", "1.0", "0x10", "one", "1e3"}) {
        EXPECT_EQ(cli::parse_number<std::uint32_t>(text), std::nullopt) << text;
    }
    EXPECT_EQ(cli::parse_number<std::uint64_t>("18446744073709551616"), std::nullopt);
    for (const char *text : {"", "nan", "inf", "-inf", "1e400", "1,5", "1.5x"}) {
        EXPECT_EQ(cli::parse_number<double>(text), std::nullopt) << text;
    }
}

TEST(Number, Share) {
    EXPECT_EQ(cli::parse_share("0.005"), 0.005);
    EXPECT_EQ(cli::parse_share("0.5%"), 0.005);
    EXPECT_EQ(cli::parse_share("-2"), -2.0); // the sign is for the option to judge
    for (const char *text : {"", "%", "1%%", "1 %", "1% ", "inf%", "nan", "1e999%"}) {
        EXPECT_EQ(cli::parse_share(text), std::nullopt) << text;
    }
}

TEST(Number, Size) {
    const auto parse_size = [](std::string_view text) { return cli::parse_numbers<2>(text, 'x'); };
    EXPECT_EQ(parse_size("1920x1080"), (std::array{1920U, 1080U}));
    for (const char *text : {"", "x", "12", "12x", "x12", "1e9x1", "-1x5", "1x-5", "1x2x3", "1X2", "4294967296x1"}) {
        EXPECT_FALSE(parse_size(text)) << text;
    }
}

} // namespace
