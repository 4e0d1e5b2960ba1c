#include "lib/api/guard.h"
#include "lib/base/log.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Outcome {
    pt_result result;
    std::string message;
};

template <typename Call>
Outcome guarded(Call &&call) {
    pt::LastError last_error;
    last_error.store("before");
    const pt_result result = pt::guard(last_error, call);
    return {result, last_error.c_str()};
}

TEST(Guard, TurnsAnythingThrownIntoInternal) {
    const Outcome outcome = guarded([] { throw 7; });
    EXPECT_EQ(outcome.result, PT_ERROR_INTERNAL);
    EXPECT_EQ(outcome.message, "an exception of unknown type");
}

TEST(ResultName, IsThatOfTheHeader) {
    EXPECT_STREQ(pt::result_name(PT_OK), "PT_OK");
    EXPECT_STREQ(pt::result_name(PT_CANCELLED), "PT_CANCELLED");
    EXPECT_STREQ(pt::result_name(PT_TARGET_REACHED), "PT_TARGET_REACHED");
    EXPECT_STREQ(pt::result_name(PT_PENDING), "PT_PENDING");
    EXPECT_STREQ(pt::result_name(PT_LIMIT_REACHED), "PT_LIMIT_REACHED");
    EXPECT_STREQ(pt::result_name(PT_ERROR_INVALID_ARGUMENT), "PT_ERROR_INVALID_ARGUMENT");
    EXPECT_STREQ(pt::result_name(PT_ERROR_INVALID_SCENE), "PT_ERROR_INVALID_SCENE");
    EXPECT_STREQ(pt::result_name(PT_ERROR_INVALID_STATE), "PT_ERROR_INVALID_STATE");
    EXPECT_STREQ(pt::result_name(PT_ERROR_UNSUPPORTED), "PT_ERROR_UNSUPPORTED");
    EXPECT_STREQ(pt::result_name(PT_ERROR_NO_DEVICE), "PT_ERROR_NO_DEVICE");
    EXPECT_STREQ(pt::result_name(PT_ERROR_OUT_OF_HOST_MEMORY), "PT_ERROR_OUT_OF_HOST_MEMORY");
    EXPECT_STREQ(pt::result_name(PT_ERROR_OUT_OF_DEVICE_MEMORY), "PT_ERROR_OUT_OF_DEVICE_MEMORY");
    EXPECT_STREQ(pt::result_name(PT_ERROR_DEVICE_LOST), "PT_ERROR_DEVICE_LOST");
    EXPECT_STREQ(pt::result_name(PT_ERROR_SHADER), "PT_ERROR_SHADER");
    EXPECT_STREQ(pt::result_name(PT_ERROR_INTERNAL), "PT_ERROR_INTERNAL");
    EXPECT_STREQ(pt::result_name(PT_ERROR_INCOMPATIBLE), "PT_ERROR_INCOMPATIBLE");
    EXPECT_STREQ(pt::result_name(PT_ERROR_FILE), "PT_ERROR_FILE");
    EXPECT_STREQ(pt::result_name(-13), "unknown result");
    EXPECT_STREQ(pt::result_name(5), "unknown result");
}

using Lines = std::vector<std::string>;

TEST(Log, PassesOnLineByLine) {
    Lines lines;
    const pt::Log log{[](void *user, int32_t level, const char *line) {
                          static_cast<Lines *>(user)->push_back(std::to_string(level) + line);
                      },
                      &lines};
    log.write(PT_LOG_WARNING, "one\n\nthree");
    log.write(PT_LOG_INFO, "ends\n");
    EXPECT_EQ(lines, (Lines{"2one", "2", "2three", "3ends"}));
}

TEST(Log, WithoutFunctionIsSilent) {
    pt::Log{}.write(PT_LOG_ERROR, "nobody listens");
}

TEST(Log, LetsNoExceptionOut) {
    const pt::Log log{[](void *, int32_t, const char *) { throw 7; }, nullptr};
    EXPECT_NO_THROW(log.write(PT_LOG_ERROR, "dropped"));
}

} // namespace
