// Numbers in the text of data files.
#pragma once

#include <string>
#include <string_view>

namespace cli {

// A decimal number, the whole text, with or without a sign. What is too small for a double is 0. Returns nullptr, or
// the rule that the text breaks; then value is as it was.
const char *parse_real(std::string_view text, double &value);

// Text of a file in quotation marks, for messages: no longer than a few words, and without bytes that are not
// printable.
std::string quoted_text(std::string_view text);

} // namespace cli
