#include "cli/data/particle_types.h"

#include "cli/base/number.h"

#include <array>
#include <cstddef>
#include <cstdio>
#include <set>

namespace cli {

std::string type_name(const Particles &particles, const ParticleColumn &column, float value) {
    if (column.has_words) {
        return particles.type_names[static_cast<std::size_t>(value)];
    }
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.9g", static_cast<double>(value));
    return text.data();
}

bool is_number(std::string_view name) {
    return parse_number<double>(name).has_value();
}

std::vector<float> types_in(const ParticleColumn &column) {
    std::set<float> types;
    const float *last = nullptr; // particles of one type often follow each other
    for (const float &value : column.values) {
        if (last == nullptr || value != *last) {
            types.insert(value);
        }
        last = &value;
    }
    return {types.begin(), types.end()};
}

} // namespace cli
