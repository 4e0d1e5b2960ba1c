#include "lib/tree/coincident_spheres.h"

#include "lib/tree/equal_words.h"
#include "lib/tree/sphere_words.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace pt {

namespace {

// Returns a different vector for each of 2^27 ranks. Components are below 2^9 steps, or 2^-21 of the grid.
glm::uvec4 steps_of(std::uint32_t rank) {
    constexpr std::uint32_t side = 512;
    return {rank % side, rank / side % side, rank / (side * side), 0};
}

} // namespace

void set_coincident_apart(std::span<glm::uvec4> places, std::span<const glm::uvec4> ways,
                          std::span<const std::uint32_t> spheres, WorkProgress &progress) {
    if (!has_equal_words(places, progress))
        return;
    const auto words = [&](std::uint32_t place) {
        return SphereWords(places[place], ways.empty() ? glm::uvec4(0) : ways[place]).all();
    };
    std::vector<std::uint32_t> sorted(places.size());
    std::iota(sorted.begin(), sorted.end(), 0U);
    std::ranges::sort(sorted, {}, [&](std::uint32_t place) { return std::pair(words(place), spheres[place]); });
    for (std::size_t first = 0, end = 0; first < sorted.size(); first = end) {
        const glm::uvec4 shared = places[sorted[first]];
        for (end = first + 1; end < sorted.size() && places[sorted[end]] == shared; ++end)
            places[sorted[end]] += steps_of(static_cast<std::uint32_t>(end - first));
    }
}

} // namespace pt
