// Tests of lib/platform/input_file.
#include "lib/platform/input_file.h"
#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace {

using platform::InputFile;

TEST(InputFile, IsReadAsFarAsIsWanted) {
    const TemporaryFolder folder;
    const std::string contents = "head" + std::string(1 << 18, 'a') + "end";
    folder.write("a", contents);
    InputFile file(folder.file("a"));
    EXPECT_EQ(file.size(), contents.size());
    EXPECT_EQ(file.first(4), "head");
    EXPECT_EQ(file.first(100'000), contents.substr(0, 100'000));
    EXPECT_EQ(file.first(1 << 20), contents);
    EXPECT_EQ(file.all(), contents);
    EXPECT_EQ(InputFile(folder.file("a")).text(), contents);
}

TEST(InputFile, TextEndsSoonAfterItsFirstNul) {
    const TemporaryFolder folder;
    std::string contents(1 << 20, 'a');
    contents[100'000] = '\0';
    folder.write("a", contents);
    const std::string text = InputFile(folder.file("a")).text();
    EXPECT_GT(text.size(), 100'000U);
    EXPECT_LT(text.size(), 200'000U);
    EXPECT_EQ(InputFile(folder.file("a")).all(), contents);
}

} // namespace
