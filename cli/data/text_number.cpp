#include "cli/data/text_number.h"

#include <charconv>
#include <cmath>
#include <system_error>

namespace cli {
namespace {

// from_chars has one error for what is too large and for what is too small. The larger range of long double tells them
// apart; what is beyond that too is refused either way.
bool is_tiny(const char *first, const char *last) {
    long double wide = 0.0L;
    return std::from_chars(first, last, wide).ec == std::errc{} && std::abs(wide) < 1.0L;
}

} // namespace

const char *parse_real(std::string_view text, double &value) {
    const bool has_plus = text.size() > 1 && text.front() == '+' && text[1] != '-'; // from_chars takes no plus
    const char *first = text.data() + (has_plus ? 1 : 0);
    const char *last = text.data() + text.size();
    double number = 0.0;
    const auto [end, error] = std::from_chars(first, last, number);
    if (error == std::errc::invalid_argument || end != last) {
        return text.find(',') == std::string_view::npos ? "must be a number" : "must be a number, with a decimal point";
    }
    if (error == std::errc::result_out_of_range && !is_tiny(first, last)) {
        return "must fit a 64-bit floating point number";
    }
    if (!std::isfinite(number)) {
        return "must be finite";
    }
    value = number;
    return nullptr;
}

std::string quoted_text(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string quoted(1, '"');
    for (const char c : text.substr(0, longest)) {
        quoted += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? '?' : c;
    }
    return quoted.append(text.size() > longest ? "...\"" : "\"");
}

} // namespace cli
