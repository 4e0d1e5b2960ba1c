#pragma once

#include "lamps.spv.h"
#include "lib/kernel/gpu_scene.h"
#include "shaders/specialization.h"
#include "tests/kernel/probe.h"

#include <array>
#include <cstdint>
#include <vector>

struct TreeVertex {
    glm::vec3 position;
    glm::vec3 normal;
    float time = 0.0F;
    std::uint32_t surface = 0xffffffffU;
};

struct TreeDrawn {
    glm::vec3 direction;
    float distance;
    std::uint32_t lamp;
    float density;
    float hit_density;
    float probability;
};

class TreeProbe {
public:
    explicit TreeProbe(const pt::GpuScene &scene) :
        lamp_count_(scene.features[pt::gpu::ID_LAMP_COUNT]),
        probe_(lamps_spirv(), sizeof(Push), constants(scene)) {
        probe_.set_scene(scene.words);
    }

    std::vector<TreeDrawn> draw(const TreeVertex &vertex, std::uint32_t count, std::uint32_t seed = 1) {
        const Push push{glm::vec4(vertex.position, 0), glm::vec4(vertex.normal, vertex.time), vertex.surface, seed,
                        lamp_count_ + count};
        return probe_.run<TreeDrawn>({}, push.count, push, push.count);
    }

    std::vector<double> probabilities(const TreeVertex &vertex) {
        std::vector<double> result;
        for (const TreeDrawn &stated : draw(vertex, 0))
            result.push_back(static_cast<double>(stated.probability));
        return result;
    }

private:
    struct Push {
        glm::vec4 position, normal_time;
        std::uint32_t surface, seed, count;
    };

    static std::array<std::uint32_t, pt::gpu::CONSTANT_COUNT> constants(const pt::GpuScene &scene) {
        auto constants = pt::specialization_constants(scene.features);
        constants[pt::gpu::ID_POINT_BLOCKS] = probe_point_blocks;
        return constants;
    }

    std::uint32_t lamp_count_;
    Probe probe_;
};

inline std::vector<TreeVertex> tree_vertices(const pt::GpuScene &scene) {
    const glm::vec3 lamp(scene.words[scene.features[pt::gpu::ID_LAMP_COUNT] / 2]);
    const float radius = scene.words[scene.features[pt::gpu::ID_LAMP_COUNT] / 2].w;
    const glm::vec3 oblique = glm::normalize(glm::vec3(2, -1, 0.5F));
    return {{{0, 0, 0}, {0, 1, 0}, 0.0F},
            {{7, 0, -3}, {0, 1, 0}, 0.375F},
            {{-4, 3, 2}, oblique, 1.0F},
            {{1, 5, -6}, {0, -1, 0}, 0.5F},
            {{0, -50, 0}, {0, 1, 0}, 0.25F},
            {{0, -50, 0}, {0, -1, 0}, 0.25F},
            {{400, 300, 5}, -glm::normalize(glm::vec3(4, 3, 0)), 0.75F},
            {lamp + 1.5F * radius * glm::vec3(0, 0, 1), {0, 0.6F, -0.8F}, 0.0F},
            {lamp, {0, 0, 1}, 0.0F, scene.features[pt::gpu::ID_LAMP_COUNT] / 2}};
}
