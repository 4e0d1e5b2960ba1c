#pragma once

#include "lib/view/scene_features.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

// The material index of surface i is component i mod 4 of the word first_index_word + i / 4.
inline std::size_t first_index_word(const pt::Features &features) {
    const std::size_t emitting =
        features.emitting_spheres() + (features[pt::gpu::ID_PLANES_EMIT] ? features[pt::gpu::ID_PLANE_COUNT] : 0);
    return features.surface_count() + emitting +
           (features[pt::gpu::ID_MOTION] ? features[pt::gpu::ID_SPHERE_COUNT] : 0) +
           (features[pt::gpu::ID_CURVATURE] ? features[pt::gpu::ID_PLANE_COUNT] : 0);
}

inline std::vector<glm::vec4> table_words(const pt::Features &features, const std::vector<glm::vec4> &words) {
    const std::size_t surfaces = features.surface_count();
    const std::size_t reflection = features[pt::gpu::ID_GLOSS] ? 2 : 1;
    const auto emission = words.begin() + static_cast<std::ptrdiff_t>(surfaces);
    std::vector<glm::vec4> result(words.begin(), emission);
    result.insert(result.end(), emission, emission + features.emitting_spheres());
    if (features[pt::gpu::ID_PLANES_EMIT])
        result.insert(result.end(), emission + features[pt::gpu::ID_SPHERE_COUNT],
                      emission + static_cast<std::ptrdiff_t>(surfaces));
    result.insert(result.end(), emission + static_cast<std::ptrdiff_t>((1 + reflection) * surfaces), words.end());
    result.resize(first_index_word(features) + (surfaces + 3) / 4);
    for (std::uint32_t i = 0; i < surfaces; ++i)
        result[first_index_word(features) + i / 4][static_cast<int>(i % 4)] =
            std::bit_cast<float>(pt::gpu::MATERIAL_INDEX_BITS + i);
    for (std::size_t i = 0; i < surfaces; ++i)
        for (std::size_t part = 0; part < reflection; ++part)
            result.push_back(words[(2 + part) * surfaces + i]);
    return result;
}
