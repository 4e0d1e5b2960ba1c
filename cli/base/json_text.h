// The text of JSON reports.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace cli {

// Names of files and devices may be any bytes, JSON is UTF-8: what is not becomes U+FFFD, so that a name never costs
// the figures beside it.
inline std::string json_text(const nlohmann::ordered_json &value) {
    return value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

} // namespace cli
