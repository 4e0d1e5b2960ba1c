// Tests of cli/source_date.
#include "cli/base/source_date.h"

#include "cli/base/exit_code.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>
#include <string>

namespace {

// Sets both for the length of a test; the time zone must not matter.
class SourceDate : public testing::Test {
protected:
    SourceDate() {
        setenv("TZ", "Pacific/Auckland", 1);
        tzset();
    }
    ~SourceDate() override {
        unsetenv("TZ");
        tzset();
        unsetenv("SOURCE_DATE_EPOCH");
    }

    static std::string date_of(const char *seconds) {
        setenv("SOURCE_DATE_EPOCH", seconds, 1);
        return cli::source_date();
    }
};

TEST_F(SourceDate, IsGivenInUniversalTime) {
    EXPECT_EQ(date_of("0"), "1970:01:01 00:00:00");
    EXPECT_EQ(date_of("1000000000"), "2001:09:09 01:46:40");
    EXPECT_EQ(date_of("4294967296"), "2106:02:07 06:28:16"); // 2^32
    EXPECT_EQ(date_of("253402300799"), "9999:12:31 23:59:59");
}

TEST_F(SourceDate, IsNoneUnlessGiven) {
    unsetenv("SOURCE_DATE_EPOCH");
    EXPECT_EQ(cli::source_date(), "");
}

TEST_F(SourceDate, RefusesWhatIsNoNumberOfSeconds) {
    for (const char *text : {"", " 1", "1 ", "-1", "+1", "1.5", "1e9", "0x10", "yesterday", "253402300800", "1e99"}) {
        try {
            const std::string date = date_of(text);
            ADD_FAILURE() << '"' << text << "\" became " << date;
        } catch (const cli::Failure &failure) {
            EXPECT_EQ(failure.code(), cli::ExitCode::usage);
            EXPECT_NE(std::string(failure.what()).find("SOURCE_DATE_EPOCH: must be"), std::string::npos);
        }
    }
}

} // namespace
