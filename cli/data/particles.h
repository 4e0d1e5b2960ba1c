// Particles as a data file holds them: one frame of a simulation, a molecule or a point cloud.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// A number for each particle, by the name that the file gives it.
struct ParticleColumn {
    std::string name;
    std::vector<float> values;
    bool has_words = false; // the values are indices into type_names
};

// The parallelepiped that a simulation fills: origin + a * edges[0] + b * edges[1] + c * edges[2], a, b, c in [0, 1].
struct SimulationBox {
    std::array<double, 3> origin{};
    std::array<std::array<double, 3>, 3> edges{};
    std::array<bool, 3> periodic{}; // what leaves the box across an edge comes in again at the other end
};

struct Particles {
    std::vector<double> positions;       // x, y, z of each particle, in the units of the file
    std::vector<ParticleColumn> columns; // those that were asked for, each as long as there are particles
    // Where types are words, like the symbols of elements.
    std::vector<std::string> type_names;
    std::optional<SimulationBox> box;

    std::size_t count() const { return positions.size() / 3; }

    // nullptr if there is none of that name.
    const ParticleColumn *find_column(std::string_view name) const {
        const auto found = std::find_if(columns.begin(), columns.end(),
                                        [name](const ParticleColumn &column) { return column.name == name; });
        return found == columns.end() ? nullptr : &*found;
    }
};

} // namespace cli
