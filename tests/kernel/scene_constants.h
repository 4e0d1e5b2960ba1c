#pragma once

#include "shaders/specialization.h"
#include "tests/kernel/probe.h"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

inline std::vector<std::uint32_t> with_scene_source(std::span<const std::uint32_t> constants, std::uint32_t source,
                                                    std::span<const glm::vec4> words) {
    std::vector<std::uint32_t> result(constants.begin(), constants.end());
    result[pt::gpu::ID_SCENE_SOURCE] = source;
    result[pt::gpu::ID_POINT_BLOCKS] = probe_point_blocks;
    if (source == pt::gpu::SCENE_IN_CONSTANTS)
        for (const glm::vec4 &word : words)
            for (int i = 0; i < 4; ++i)
                result.push_back(std::bit_cast<std::uint32_t>(word[i]));
    return result;
}

// If the scene is in constants, the buffer gets wrong words.
inline void set_scene_for(Probe &probe, std::uint32_t source, std::span<const glm::vec4> words) {
    if (source == pt::gpu::SCENE_IN_CONSTANTS)
        probe.set_scene(std::vector<glm::vec4>(words.size(), glm::vec4(-77.0F)));
    else
        probe.set_scene(words);
}
