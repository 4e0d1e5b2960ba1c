// The types of particles, by their names: symbols of elements, other words, or numbers.
#pragma once

#include "cli/data/particles.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// A column of types: "element" is preferred where a file has both that and "type", as it says more.
inline constexpr const char *type_column = "type";
inline constexpr const char *element_column = "element";

// "H", "water" or "2". value: of a column of types.
std::string type_name(const Particles &particles, const ParticleColumn &column, float value);

// Those that there are, each once, in ascending order of their values: words are in the order of the file.
std::vector<float> types_in(const ParticleColumn &column);

bool is_number(std::string_view name);

// The column whose types a table names: "type" if all are numbers. No table: "element".
template <typename Value>
std::string column_named_by(const std::map<std::string, Value> &table) {
    const bool has_numbers =
        std::all_of(table.begin(), table.end(), [](const auto &entry) { return is_number(entry.first); });
    return has_numbers && !table.empty() ? type_column : element_column;
}

// For messages: "1, 2 and 5".
template <typename Value>
std::string names_in(const std::map<std::string, Value> &table) {
    std::string names;
    for (const auto &entry : table) {
        const bool is_last = &entry == &*table.rbegin();
        names.append(names.empty() ? "" : is_last ? " and " : ", ").append(entry.first);
    }
    return names;
}

} // namespace cli
