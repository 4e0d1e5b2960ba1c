#include "lib/platform/input_file.h"
#include "lib/platform/printable.h"
#include "tests/cli/temporary_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace {

using platform::InputFile;
using platform::printable;

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

TEST(Printable, ShowsWhatSteersTerminals) {
    EXPECT_EQ(printable("\x1b[2J\r\n\t\x7f"), "<U+001B>[2J<U+000D><U+000A><U+0009><U+007F>");
    EXPECT_EQ(printable(std::string("a\0b", 3)), "a<U+0000>b");
    EXPECT_EQ(printable("\u009b \u061c\u200e\u200f \u2028\u2029\u202a\u202e \u2066\u2069"),
              "<U+009B> <U+061C><U+200E><U+200F> <U+2028><U+2029><U+202A><U+202E> <U+2066><U+2069>");
    EXPECT_EQ(printable("\x9b"
                        "1m"),
              "<U+009B>1m");
    EXPECT_EQ(printable("\xc0\x9b"), "<U+001B>"); // overlong
    EXPECT_EQ(printable("\xe2\x80"), "\xe2<U+0080>");
    EXPECT_EQ(platform::printable_lines("a\n\x1b"), "a\n<U+001B>");
}

TEST(Printable, LeavesAllElse) {
    for (const char *text :
         {"", "caf\u00e9 \u4e16\u754c \U0001f3a8 \u200d\u0301 ~", "sc\xe8ne", "\u00a0\u2027\u202f\u2065\u206a"})
        EXPECT_EQ(printable(text), text);
}

} // namespace
