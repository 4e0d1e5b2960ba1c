#include "cli/data/periodic_wrap.h"

#include "cli/base/exit_code.h"

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cli {
namespace {

std::array<glm::dvec3, 3> edges_as_vectors(const SimulationBox &box) {
    return {glm::make_vec3(box.edges[0].data()), glm::make_vec3(box.edges[1].data()),
            glm::make_vec3(box.edges[2].data())};
}

// What gives the shares of the edges: the rows of the inverse of the matrix whose columns are the edges, which are
// cross products of the others, over the volume (Cramer).
std::array<glm::dvec3, 3> reciprocal_edges(const std::array<glm::dvec3, 3> &edges, const std::string &file) {
    const double volume = glm::dot(edges[0], glm::cross(edges[1], edges[2]));
    if (volume == 0.0 || !std::isfinite(volume)) {
        throw Failure(ExitCode::scene,
                      file + ": the simulation box has no volume, into which particles could be wrapped");
    }
    std::array<glm::dvec3, 3> reciprocal{};
    for (std::size_t i = 0; i < edges.size(); ++i) {
        reciprocal[i] = glm::cross(edges[(i + 1) % 3], edges[(i + 2) % 3]) / volume;
    }
    return reciprocal;
}

} // namespace

void wrap_into_box(Particles &particles, const std::string &file) {
    if (!particles.box) {
        return;
    }
    const SimulationBox &box = *particles.box;
    const std::array<glm::dvec3, 3> edges = edges_as_vectors(box);
    const std::array<glm::dvec3, 3> reciprocal = reciprocal_edges(edges, file);
    const glm::dvec3 origin = glm::make_vec3(box.origin.data());
    for (std::size_t i = 0; i < particles.count(); ++i) {
        glm::dvec3 position = glm::make_vec3(&particles.positions[3 * i]);
        const glm::dvec3 offset = position - origin;
        for (std::size_t edge = 0; edge < edges.size(); ++edge) {
            const double turns = box.periodic[edge] ? std::floor(glm::dot(reciprocal[edge], offset)) : 0.0;
            if (turns != 0.0) {
                position -= turns * edges[edge];
            }
        }
        std::copy_n(glm::value_ptr(position), 3, &particles.positions[3 * i]);
    }
}

} // namespace cli
