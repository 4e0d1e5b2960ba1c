// Messages on stderr.
#pragma once

#include <iostream>
#include <sstream>
#include <string>

namespace cli {

// Every line begins with the program's name.
inline void print_message(const std::string &message) {
    std::istringstream lines(message);
    for (std::string line; std::getline(lines, line);) {
        std::cerr << "pt: " << line << '\n';
    }
    std::cerr << std::flush;
}

} // namespace cli
