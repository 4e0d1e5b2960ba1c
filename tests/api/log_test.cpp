#include "tests/api/api_fixture.h"

#include <pt/devices.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace api {

namespace {

using Lines = std::vector<std::string>;

class LogTest : public ApiTest {
protected:
    static void collect(void *user, int32_t level, const char *line) {
        static_cast<Lines *>(user)->push_back(std::to_string(level) + " " + line);
    }
};

TEST_F(LogTest, NamesTheDeviceAndTheKernelsBuilt) {
    Lines lines;
    const Context logged = create_context([&](pt_create_info &info) {
        info.flags = 0;
        info.log = &LogTest::collect;
        info.log_user = &lines;
    });
    pt_device_info device{};
    ASSERT_EQ(pt_get_context_device(logged.get(), &device), PT_OK);
    EXPECT_EQ(lines, (Lines{std::string("3 renders on ") + device.name + " (" + device.driver + ")"}));
    lines.clear();
    ASSERT_NO_FATAL_FAILURE(api::set_all(logged.get()));
    EXPECT_EQ(lines, Lines{});
    const pt_accumulate_info one = samples(1);
    ASSERT_EQ(pt_accumulate(logged.get(), &one), PT_OK);
    ASSERT_EQ(lines.size(), 1U);
    const std::string &built = lines[0];
    EXPECT_TRUE(built.starts_with("3 built a kernel for this scene alone in ") ||
                built.starts_with("3 built a kernel for all scenes of this kind in "))
        << built;
    EXPECT_TRUE(built.ends_with(" ms")) << built;
    lines.clear();
    ASSERT_EQ(pt_accumulate(logged.get(), &one), PT_OK);
    EXPECT_EQ(lines, Lines{}) << "the kernel is there";
}

} // namespace

} // namespace api
