#include "cli/help/paragraphs.h"

#include <algorithm>
#include <sstream>

namespace cli {
namespace {

TableRow table_row(const std::string &line) {
    const std::size_t key = line.find_first_not_of(' ');
    const std::size_t end = line.find(' ', key);
    return {line.substr(key, end - key), line.substr(std::min(line.find_first_not_of(' ', end), line.size()))};
}

bool is_row(const std::string &line) {
    return line.starts_with("  ");
}

void add_line(Paragraph &paragraph, const std::string &line) {
    if (is_row(line)) {
        if (paragraph.rows.empty()) {
            paragraph.title = paragraph.text.substr(0, paragraph.text.find(':'));
            paragraph.text.clear();
        }
        paragraph.rows.push_back(table_row(line));
    } else {
        paragraph.text += (paragraph.text.empty() ? "" : " ") + line;
    }
}

} // namespace

std::vector<Paragraph> paragraphs(std::string_view notes) {
    std::vector<Paragraph> all;
    std::istringstream lines{std::string(notes)};
    bool is_new = true;
    for (std::string line; std::getline(lines, line);) {
        if (line.empty()) {
            is_new = true;
            continue;
        }
        if (is_new) {
            all.emplace_back();
            is_new = false;
        }
        add_line(all.back(), line);
    }
    return all;
}

std::string wrapped(std::string_view text, std::size_t indentation, std::size_t width, std::size_t begun) {
    std::string lines;
    std::size_t column = begun;
    bool is_first = true; // word of its line
    std::istringstream words{std::string(text)};
    for (std::string word; words >> word; is_first = false) {
        if (!is_first && column + 1 + word.size() > width) {
            lines.append(1, '\n').append(indentation, ' ');
            column = indentation;
            is_first = true;
        }
        lines += (is_first ? "" : " ") + word;
        column += word.size() + (is_first ? 0 : 1);
    }
    return lines;
}

} // namespace cli
