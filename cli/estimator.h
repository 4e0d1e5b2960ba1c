// Owns the names of pt.h's estimators.
// Called by the scene file reader, the options and the report.
#pragma once

#include <pt/pt.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace cli {

inline constexpr std::array<std::string_view, 3> estimator_names{"best", "uniform", "mis"};
inline constexpr std::array<std::uint32_t, 3> estimator_values{PT_ESTIMATOR_BEST, PT_ESTIMATOR_UNIFORM,
                                                               PT_ESTIMATOR_MIS};

constexpr std::optional<std::uint32_t> find_estimator(std::string_view name) {
    const auto found = std::find(estimator_names.begin(), estimator_names.end(), name);
    if (found == estimator_names.end()) {
        return std::nullopt;
    }
    return estimator_values[static_cast<std::size_t>(found - estimator_names.begin())];
}

constexpr std::string_view estimator_name(std::uint32_t value) {
    const auto found = std::find(estimator_values.begin(), estimator_values.end(), value);
    return estimator_names.at(static_cast<std::size_t>(found - estimator_values.begin()));
}

} // namespace cli
