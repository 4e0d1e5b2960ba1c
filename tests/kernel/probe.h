#pragma once

#include "lib/points/point_sequence.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"
#include "lib/vulkan/instance.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

pt::vulkan::Device &probe_device();

// Probes have this ID_POINT_BLOCKS. The points take 16 KiB, which every device allows.
inline constexpr std::uint32_t probe_point_blocks = 1024;

class Probe {
public:
    // constants[i] has the bits of specialization constant i. Other constants keep the shaders' defaults.
    Probe(std::span<const std::uint32_t> spirv, std::uint32_t push_bytes,
          std::span<const std::uint32_t> constants = {});

    // Sets the scene buffer (bindings 0 and 1), the tree buffer (5) and the table of points (4).
    void set_scene(std::span<const glm::vec4> words) { scene_.assign(words.begin(), words.end()); }
    void set_tree(std::span<const glm::uvec4> nodes, std::span<const glm::uvec4> spheres) {
        tree_nodes_.assign(nodes.begin(), nodes.end());
        tree_spheres_.assign(spheres.begin(), spheres.end());
    }
    void set_points(std::span<const pt::PointBlock> blocks) { points_.assign(blocks.begin(), blocks.end()); }

    // Runs one invocation per item. The input is at binding 3. Returns binding 2, which is initially zero. The guard
    // words after it must stay unchanged.
    template <typename Output, typename Push>
    std::vector<Output> run(std::span<const glm::vec4> input, std::size_t output_count, const Push &push,
                            std::uint32_t invocations) {
        std::vector<Output> output(output_count);
        run_over(std::as_bytes(input), std::as_writable_bytes(std::span(output)), std::as_bytes(std::span(&push, 1)),
                 invocations);
        return output;
    }

    // Like run(), but writes into `output`. Parts that the kernel does not write stay unchanged.
    void run_over(std::span<const std::byte> input, std::span<std::byte> output, std::span<const std::byte> push,
                  std::uint32_t invocations);

private:
    pt::vulkan::ComputePipeline pipeline_;
    std::vector<glm::vec4> scene_;
    std::vector<glm::uvec4> tree_nodes_;
    std::vector<glm::uvec4> tree_spheres_;
    std::vector<pt::PointBlock> points_;
};
