// Messages on stderr.
#pragma once

#include <cstddef>
#include <iostream>
#include <sstream>
#include <string>

namespace cli {

// A line without its middle if it is very long, as with a number of a million digits: what it is about comes first, and
// the rule last. No UTF-8 sequence is cut.
inline std::string shortened(const std::string &line) {
    constexpr std::size_t longest = 2000;
    constexpr std::size_t kept = 900; // at each end
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

// Every line begins with the program's name.
inline void print_message(const std::string &message) {
    std::istringstream lines(message);
    for (std::string line; std::getline(lines, line);)
        std::cerr << "pt: " << shortened(line) << '\n';
    std::cerr << std::flush;
}

} // namespace cli
