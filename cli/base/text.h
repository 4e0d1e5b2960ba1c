#pragma once

#include "lib/platform/printable.h"
#include "lib/scene_file/text.h"

#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>

namespace cli {

using pt::concat;
using pt::listed;

// Like printf, truncated to 255 characters.
// NOLINTNEXTLINE(cert-dcl50-cpp): compilers check the arguments
__attribute__((format(printf, 1, 2))) inline std::string formatted(const char *format, ...) {
    char text[256];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return text;
}

inline std::string percent_text(double share) {
    return formatted("%.3g%%", 100.0 * share);
}

inline std::string counted(std::uint64_t count, const std::string &noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

// Removes the middle of a long message, because its subject and its rule are at the ends.
inline std::string shortened(const std::string &line) {
    constexpr std::size_t longest = 2000;
    constexpr std::size_t kept = 900;
    if (line.size() <= longest)
        return line;
    const auto is_inside = [&](std::size_t place) {
        return (static_cast<unsigned char>(line[place]) & 0xc0U) == 0x80U;
    };
    std::size_t end = kept;
    std::size_t begin = line.size() - kept;
    while (end > kept - 3 && is_inside(end))
        --end;
    while (begin < line.size() - kept + 3 && is_inside(begin))
        ++begin;
    return line.substr(0, end) + " [...] " + line.substr(begin);
}

inline void print_message(const std::string &message) {
    std::istringstream lines(message);
    for (std::string line; std::getline(lines, line);)
        std::cerr << "pt: " << shortened(platform::printable(line)) << '\n';
    std::cerr << std::flush;
}

} // namespace cli
