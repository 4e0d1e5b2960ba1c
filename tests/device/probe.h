// Runs a small kernel that calls the shipped shader functions on the device, for the tests that compare their results.
#pragma once

#include "lib/kernel/point_sequence.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"
#include "lib/vulkan/instance.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// The device that all probes of a test program share, with the validation layer unless PT_TEST_NO_VALIDATION is set.
pt::vulkan::Device &probe_device();

// What probes have for the specialization constant ID_POINT_BLOCKS: the 16 KiB that every device offers.
inline constexpr std::uint32_t probe_point_blocks = 1024;

class Probe {
public:
    // constants[i] are the bits of the specialization constant with id i; without them the shaders' defaults hold.
    Probe(std::span<const std::uint32_t> spirv, std::uint32_t push_bytes,
          std::span<const std::uint32_t> constants = {});

    // What the following runs find in the scene buffer (bindings 0 and 1), in the tree buffer (binding 5) and in the
    // table of points (binding 4), which holds up to probe_point_blocks.
    void set_scene(std::span<const glm::vec4> words) { scene_.assign(words.begin(), words.end()); }
    void set_tree(std::span<const glm::uvec4> nodes, std::span<const glm::uvec4> spheres) {
        tree_nodes_.assign(nodes.begin(), nodes.end());
        tree_spheres_.assign(spheres.begin(), spheres.end());
    }
    void set_points(std::span<const pt::PointBlock> blocks) { points_.assign(blocks.begin(), blocks.end()); }

    // Gives the kernel input (binding 3) and push constants, runs one invocation per item of invocations, and returns
    // output_count values (binding 2, zero before). Guard words after the output must survive.
    template <typename Output, typename Push>
    std::vector<Output> run(std::span<const glm::vec4> input, std::size_t output_count, const Push &push,
                            std::uint32_t invocations) {
        std::vector<Output> output(output_count);
        run_over(std::as_bytes(input), std::as_writable_bytes(std::span(output)), std::as_bytes(std::span(&push, 1)),
                 invocations);
        return output;
    }

    // The same over an output that is not empty: what the kernel does not write, stays.
    void run_over(std::span<const std::byte> input, std::span<std::byte> output, std::span<const std::byte> push,
                  std::uint32_t invocations);

private:
    pt::vulkan::ComputePipeline pipeline_;
    std::vector<glm::vec4> scene_;
    std::vector<glm::uvec4> tree_nodes_;
    std::vector<glm::uvec4> tree_spheres_;
    std::vector<pt::PointBlock> points_;
};
