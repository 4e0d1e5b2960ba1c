#include "cli/figure/box_lines.h"

#include <glm/gtc/type_ptr.hpp>

#include <cstddef>

namespace cli {

// Bit i of a corner's number says whether it is at the end of edge i.
std::array<glm::dvec3, 8> corners_of(const SimulationBox &box) {
    std::array<glm::dvec3, 8> corners{};
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
        corners[corner] = glm::make_vec3(box.origin.data());
        for (std::size_t edge = 0; edge < box.edges.size(); ++edge) {
            if ((corner >> edge & 1U) != 0) {
                corners[corner] += glm::make_vec3(box.edges[edge].data());
            }
        }
    }
    return corners;
}

std::array<Segment, 12> edges_of(const SimulationBox &box) {
    const std::array<glm::dvec3, 8> corners = corners_of(box);
    std::array<Segment, 12> edges{};
    std::size_t count = 0;
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
        for (std::size_t edge = 0; edge < box.edges.size(); ++edge) {
            if ((corner >> edge & 1U) == 0) {
                edges[count++] = {corners[corner], corners[corner | std::size_t{1} << edge]};
            }
        }
    }
    return edges;
}

} // namespace cli
