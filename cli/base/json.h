#pragma once

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace cli {

// Replaces invalid UTF-8 by U+FFFD.
inline std::string json_text(const nlohmann::ordered_json &value) {
    return value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

inline nlohmann::ordered_json number_or_null(double number) {
    return std::isfinite(number) ? nlohmann::ordered_json(number) : nlohmann::ordered_json(nullptr);
}

} // namespace cli
