// Literals of Python, as far as heads of NPY files have them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cli {

struct PythonLiteral {
    enum class Kind { text, whole_number, boolean, sequence, dictionary };

    Kind kind;
    std::string text;
    std::uint64_t number = 0;            // 0 or 1 of a boolean
    std::vector<PythonLiteral> elements; // of a tuple or a list; of a dictionary key, value, key, value

    // The value of that key; nullptr if there is none.
    const PythonLiteral *find(std::string_view key) const;
};

// Nothing if the whole text is no such literal: a text, a whole number from 0, True or False, or a tuple, a list or a
// dictionary of them.
std::optional<PythonLiteral> parse_python_literal(std::string_view text);

} // namespace cli
