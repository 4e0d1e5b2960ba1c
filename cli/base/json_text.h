// The text of JSON reports, and numbers in them.
#pragma once

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace cli {

// Names of files and devices may be any bytes, JSON is UTF-8: what is not becomes U+FFFD, so that a name never costs
// the figures beside it.
inline std::string json_text(const nlohmann::ordered_json &value) {
    return value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

// JSON has no infinity: null stands for an unknown error, or one beyond all numbers.
inline nlohmann::ordered_json number_or_null(double number) {
    return std::isfinite(number) ? nlohmann::ordered_json(number) : nlohmann::ordered_json(nullptr);
}

} // namespace cli
