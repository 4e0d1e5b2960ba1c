// The notes below a command's options: paragraphs with an empty line between them. One whose second line is indented is
// a table with a title: "Exit codes:", then "  0    done", and maybe a remark below.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cli {

struct TableRow {
    std::string key;
    std::string text;
};

struct Paragraph {
    std::string title;          // of a table, without its colon; else empty
    std::vector<TableRow> rows; // of a table
    std::string text;           // of a table: the remark
};

std::vector<Paragraph> paragraphs(std::string_view notes);

// Broken into lines of so many characters at most, where words allow it. The first line begins at the column `begun`;
// the others are indented.
std::string wrapped(std::string_view text, std::size_t indentation, std::size_t width, std::size_t begun);

} // namespace cli
