#include "cli/figure/periodic_wrap.h"

#include "cli/base/exit_code.h"
#include "cli/figure/vector3.h"

#include <cmath>
#include <cstddef>

namespace cli {
namespace {

// What gives the shares of the edges: the rows of the inverse of the matrix whose columns are the edges, which are
// cross products of the others, over the volume (Cramer).
std::array<Vector3, 3> reciprocal_edges(const SimulationBox &box) {
    const auto &edges = box.edges;
    const double volume = dot(edges[0], cross(edges[1], edges[2]));
    if (volume == 0.0 || !std::isfinite(volume)) {
        throw Failure(ExitCode::file, "--wrap: the simulation box has no volume");
    }
    std::array<Vector3, 3> reciprocal{};
    for (std::size_t i = 0; i < edges.size(); ++i) {
        reciprocal[i] = moved({}, 1.0 / volume, cross(edges[(i + 1) % 3], edges[(i + 2) % 3]));
    }
    return reciprocal;
}

} // namespace

void wrap_into_box(Particles &particles) {
    if (!particles.box) {
        return;
    }
    const SimulationBox &box = *particles.box;
    const std::array<Vector3, 3> reciprocal = reciprocal_edges(box);
    for (std::size_t i = 0; i < particles.count(); ++i) {
        Vector3 position{particles.positions[3 * i], particles.positions[3 * i + 1], particles.positions[3 * i + 2]};
        const Vector3 offset = moved(position, -1.0, box.origin);
        for (std::size_t edge = 0; edge < box.edges.size(); ++edge) {
            const double turns = box.periodic[edge] ? std::floor(dot(reciprocal[edge], offset)) : 0.0;
            if (turns != 0.0) {
                position = moved(position, -turns, box.edges[edge]);
            }
        }
        for (std::size_t axis = 0; axis < position.size(); ++axis) {
            particles.positions[3 * i + axis] = position[axis];
        }
    }
}

} // namespace cli
