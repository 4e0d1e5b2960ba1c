// Manual pages: what groff would take for something else is escaped.
#include "cli/help/man_page.h"

#include <gtest/gtest.h>

namespace {

cli::CommandText described(const std::string &description) {
    cli::CommandText command{};
    command.name = "pt draw";
    command.description = "Draw";
    command.groups.push_back({"Options", {{{"-x", "--extent"}, "N", false, false, description}}});
    return command;
}

std::string entry(const std::string &description) {
    const cli::CommandText command = described(description);
    const std::string page = cli::man_page(command, command, "1.2.3", "2001-09-09");
    const std::size_t begin = page.find(".SH OPTIONS\n");
    return page.substr(begin, page.find(".SH SEE") - begin);
}

TEST(ManPage, ShowsAnOption) {
    EXPECT_EQ(entry("As large"), ".SH OPTIONS\n.TP\n\\fB\\-x\\fR, \\fB\\-\\-extent\\fR \\fIN\\fR\nAs large\n");
}

TEST(ManPage, NoLineBeginsWithADotOfItsOwn) {
    EXPECT_NE(entry(".png").find("\n\\&.png\n"), std::string::npos);
    // The second line is broken before ".exr".
    const std::string first(61, 'a');
    EXPECT_NE(entry(first + " .exr a.b").find("\n" + first + "\n\\&.exr a.b\n"), std::string::npos);
}

TEST(ManPage, HyphensAndQuotesStayWhatTheyAre) {
    EXPECT_NE(entry("a-b 'c' `d` e^2 ~f \\g").find("\na\\-b \\(aqc\\(aq \\(gad\\(ga e\\(ha2 \\(tif \\eg\n"),
              std::string::npos);
}

} // namespace
