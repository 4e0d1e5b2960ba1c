#pragma once

#include "lib/kernel/gpu_scene.h"
#include "lib/kernel/scene_blocks.h"
#include "shaders/specialization.h"
#include "tests/light/lamp_tree_probe.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

inline constexpr double uniform_share = 0.1;

// Reads the words of the tree as gpu_layout.h describes them.
class TreeReference {
public:
    explicit TreeReference(const pt::GpuScene &scene) : features_(scene.features), words_(scene.words) {
        words_.erase(words_.begin(),
                     words_.begin() + static_cast<std::ptrdiff_t>(pt::SceneBlocks(features_).lamp_tree));
        while (features_[pt::gpu::ID_LAMP_COUNT] > 16U << (2 * levels_))
            ++levels_;
        top_ = (features_[pt::gpu::ID_LAMP_COUNT] + (4U << (2 * levels_)) - 1) / (4U << (2 * levels_));
    }

    std::vector<double> probabilities(const TreeVertex &vertex) const {
        std::vector<double> shares(features_[pt::gpu::ID_LAMP_COUNT]);
        std::vector<std::array<double, 4>> groups;
        double total = 0.0;
        for (std::uint32_t group = 0; group < top_; ++group) {
            groups.push_back(importance(group, vertex));
            total += sum(groups.back());
        }
        for (std::uint32_t group = 0; group < top_; ++group) {
            const double part = total > 0.0 ? sum(groups[group]) / total : 1.0 / top_;
            descend(group, groups[group], part, 0, top_, vertex, shares);
        }
        for (double &share : shares)
            share = (1.0 - uniform_share) * share + uniform_share / features_[pt::gpu::ID_LAMP_COUNT];
        return shares;
    }

private:
    static double sum(const std::array<double, 4> &of) { return of[0] + of[1] + of[2] + of[3]; }

    double number(std::uint64_t group, std::size_t word, int node) const {
        return words_[pt::gpu::lamp_tree_group_words(features_[pt::gpu::ID_MOTION]) * group + word][node];
    }

    bool is_leaf(std::uint64_t group) const { return group >= top_ * ((1U << (2 * levels_)) - 1) / 3; }

    std::uint32_t lamp_of(std::uint64_t group, int node) const {
        const std::uint32_t above = top_ * ((1U << (2 * levels_)) - 1) / 3;
        const std::uint32_t groups = top_ * ((4U << (2 * levels_)) - 1) / 3;
        return std::bit_cast<std::uint32_t>(
                   words_[pt::gpu::lamp_tree_group_words(features_[pt::gpu::ID_MOTION]) * groups + group - above]
                         [node]) -
               pt::gpu::MATERIAL_INDEX_BITS;
    }

    std::array<double, 4> importance(std::uint64_t group, const TreeVertex &vertex) const {
        std::array<double, 4> result{};
        for (int node = 0; node < 4; ++node) {
            glm::dvec3 way(0.0);
            if (features_[pt::gpu::ID_MOTION])
                way = {number(group, 5, node), number(group, 6, node), number(group, 7, node)};
            const glm::dvec3 place(number(group, 0, node), number(group, 1, node), number(group, 2, node));
            const glm::dvec3 to = place + double{vertex.time} * way - glm::dvec3(vertex.position);
            const double height = glm::dot(to, glm::dvec3(vertex.normal));
            const double power = number(group, 3, node);
            const double spread = number(group, 4, node);
            double &value = result[static_cast<std::size_t>(node)];
            if (is_leaf(group)) {
                const double squared = glm::dot(to, to);
                if (power > 0.0 && height + spread > 0.0 && squared > spread * spread)
                    value = power / squared * std::min(1.0, (height + spread) / std::sqrt(squared));
            } else {
                const double squared = glm::dot(to, to) + spread / 2;
                const double variance = spread / 3;
                const double root = std::sqrt(height * height + variance);
                const double mean = height < 0.0 ? variance / (root - height) / 2 : (height + root) / 2;
                value = power / squared * std::min(1.0, mean / std::sqrt(squared));
            }
        }
        return result;
    }

    void descend(std::uint64_t group, std::array<double, 4> parts, double probability, std::uint64_t level_first,
                 std::uint64_t level_count, const TreeVertex &vertex, std::vector<double> &shares) const {
        for (int node = 0; node < 4; ++node)
            if (sum(importance(group, vertex)) == 0.0)
                parts[static_cast<std::size_t>(node)] = number(group, 3, node) > 0.0 ? 1.0 : 0.0;
        for (int node = 0; node < 4; ++node) {
            const double part = probability * parts[static_cast<std::size_t>(node)] / sum(parts);
            if (part == 0.0)
                continue;
            if (is_leaf(group)) {
                shares[lamp_of(group, node)] += part;
                continue;
            }
            const std::uint64_t next_first = level_first + level_count;
            const std::uint64_t child = next_first + 4 * (group - level_first) + static_cast<std::uint64_t>(node);
            descend(child, importance(child, vertex), part, next_first, 4 * level_count, vertex, shares);
        }
    }

    pt::Features features_;
    std::vector<glm::vec4> words_;
    std::uint32_t levels_ = 1;
    std::uint32_t top_ = 0;
};

inline std::vector<double> lamp_weights(const pt::GpuScene &scene, const TreeVertex &vertex) {
    std::vector<double> weights;
    const pt::SceneBlocks blocks(scene.features);
    for (std::uint32_t lamp = 0; lamp < scene.features[pt::gpu::ID_LAMP_COUNT]; ++lamp) {
        glm::dvec3 to = glm::dvec3(glm::vec3(scene.words[lamp])) - glm::dvec3(vertex.position);
        if (scene.features[pt::gpu::ID_MOTION])
            to += double{vertex.time} * glm::dvec3(glm::vec3(scene.words[blocks.motion + lamp]));
        const double radius = double{scene.words[lamp].w};
        const double distance = glm::length(to);
        const double cosine = std::min(1.0, (glm::dot(to, glm::dvec3(vertex.normal)) + radius) / distance);
        const bool sampled = distance > radius && cosine > 0.0 && lamp != vertex.surface;
        const double radiance = double{scene.words[blocks.emission + lamp].w};
        weights.push_back(sampled ? radiance * std::pow(radius / distance, 2) * cosine : 0.0);
    }
    return weights;
}
