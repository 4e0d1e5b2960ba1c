// What shells complete of the values that help names.
#include "cli/help/paragraphs.h"
#include "cli/help/value_words.h"

#include <gtest/gtest.h>

namespace {

using Words = std::vector<std::string>;
using Endings = std::vector<std::string_view>;

TEST(ValueWords, AreThoseWithoutCapitals) {
    EXPECT_EQ(cli::value_words("none|halton-cp|16").words, (Words{"none", "halton-cp", "16"}));
    EXPECT_EQ(cli::value_words("EV|auto").words, Words{"auto"});
    EXPECT_EQ(cli::value_words("WxH").words, Words{});
    EXPECT_EQ(cli::value_words("").words, Words{});
    EXPECT_FALSE(cli::value_words("a|b").is_list);
    const cli::ValueWords list = cli::value_words("a|b,...");
    EXPECT_TRUE(list.is_list);
    EXPECT_EQ(list.words, (Words{"a", "b"}));
}

TEST(ValueWords, FilesAndFolders) {
    EXPECT_EQ(cli::value_words("IMAGE").endings, (Endings{".exr", ".png", ".jpg", ".jpeg"}));
    EXPECT_EQ(cli::value_words("FILM").endings, Endings{".ptfilm"});
    EXPECT_TRUE(cli::value_words("FILE").is_file);
    EXPECT_TRUE(cli::value_words("FILE").endings.empty());
    EXPECT_TRUE(cli::value_words("DIR").is_folder);
    EXPECT_FALSE(cli::value_words("DIR").is_file);
    EXPECT_FALSE(cli::value_words("N").is_file);
}

TEST(Paragraphs, TablesAreTold) {
    const auto found = cli::paragraphs("One\ntwo.\n\nCodes:\n  0   done\n  75  not yet\nSo.\n");
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].text, "One two.");
    EXPECT_EQ(found[1].title, "Codes");
    ASSERT_EQ(found[1].rows.size(), 2U);
    EXPECT_EQ(found[1].rows[1].key + ":" + found[1].rows[1].text, "75:not yet");
    EXPECT_EQ(found[1].text, "So.");
}

TEST(Paragraphs, LinesAreBrokenWhereTheyHaveTo) {
    EXPECT_EQ(cli::wrapped("ab cd ef", 0, 5, 0), "ab cd\nef");
    EXPECT_EQ(cli::wrapped("ab cd ef", 2, 5, 3), "ab\n  cd\n  ef");
    EXPECT_EQ(cli::wrapped("toolong b", 0, 5, 0), "toolong\nb");
    EXPECT_EQ(cli::wrapped("", 0, 5, 0), "");
}

} // namespace
