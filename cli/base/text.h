// Texts for people, put together from their parts.
#pragma once

#include <cstdarg>
#include <cstdio>
#include <sstream>
#include <string>

namespace cli {

// The parts one after the other, as streams write them.
template <typename... Parts>
std::string concat(const Parts &...parts) {
    std::ostringstream text;
    (text << ... << parts);
    return text.str();
}

// As printf writes it; what is longer than 255 characters is cut off.
__attribute__((format(printf, 1, 2))) inline std::string formatted(const char *format, ...) {
    char text[256];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return text;
}

// Three significant digits, so that 0.0031% can be told from 0; without exponent for what is seen in pictures.
inline std::string percent_text(double share) {
    return formatted("%.3g%%", 100.0 * share);
}

// "a, b, c"
template <typename Texts>
std::string listed(const Texts &texts, const char *between = ", ") {
    std::string list;
    for (const auto &text : texts)
        list.append(list.empty() ? "" : between).append(text);
    return list;
}

} // namespace cli
