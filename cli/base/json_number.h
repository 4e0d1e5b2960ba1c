// Numbers in JSON reports: JSON has no infinity.
#pragma once

#include <nlohmann/json.hpp>

#include <cmath>

namespace cli {

// null stands for what is infinite: an unknown error, or one beyond all numbers.
inline nlohmann::ordered_json number_or_null(double number) {
    return std::isfinite(number) ? nlohmann::ordered_json(number) : nlohmann::ordered_json(nullptr);
}

} // namespace cli
