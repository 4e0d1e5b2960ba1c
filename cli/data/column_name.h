// Names of columns.
#pragma once

#include <cstddef>
#include <string>

namespace cli {

// What one of several numbers of a particle is called, counted from 0: "velocity[2]".
inline std::string component_name(const std::string &name, std::size_t component) {
    return std::string(name).append("[").append(std::to_string(component)).append("]");
}

} // namespace cli
