#include "tests/kernel/probe.h"

#include "lib/vulkan/device_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

namespace {

void on_message(void *, int32_t level, const char *line) {
    if (level <= PT_LOG_WARNING)
        ADD_FAILURE() << "the Vulkan layer says: " << line;
}

// The device that pt_create() would choose.
struct SharedDevice {
    pt::Log log{&on_message, nullptr};
    pt::vulkan::Instance instance{log, std::getenv("PT_TEST_NO_VALIDATION") == nullptr};
    pt::vulkan::Device device{instance, chosen(), pt::vulkan::default_policy(pt::vulkan::describe(chosen()))};

    vk::raii::PhysicalDevice chosen() const {
        std::vector<vk::raii::PhysicalDevice> devices = instance.physical_devices();
        std::vector<pt_device_info> infos;
        for (const vk::raii::PhysicalDevice &candidate : devices)
            infos.push_back(pt::vulkan::describe(candidate));
        return devices[pt::vulkan::choose_device(infos, "")];
    }
};

constexpr pt::vulkan::Binding bindings[] = {{0, vk::DescriptorType::eUniformBuffer},
                                            {1},
                                            {2},
                                            {3},
                                            {4, vk::DescriptorType::eUniformBuffer},
                                            {5, vk::DescriptorType::eUniformTexelBuffer},
                                            {6, vk::DescriptorType::eUniformTexelBuffer},
                                            {7}};

constexpr std::size_t guard_bytes = 4096;
constexpr std::byte guard_value{0xa5};
constexpr std::uint32_t workgroup_size = 64;
constexpr std::size_t scene_bytes = 16384; // Every device allows uniform buffers of this size.

} // namespace

pt::vulkan::Device &probe_device() {
    static SharedDevice shared;
    return shared.device;
}

Probe::Probe(std::span<const std::uint32_t> spirv, std::uint32_t push_bytes, std::span<const std::uint32_t> constants) :
    pipeline_(probe_device(), spirv, bindings, push_bytes, constants) {}

void Probe::run_over(std::span<const std::byte> input, std::span<std::byte> output, std::span<const std::byte> push,
                     std::uint32_t invocations) {
    using pt::vulkan::Buffer;
    using pt::vulkan::BufferUse;
    pt::vulkan::Device &device = probe_device();
    ASSERT_LE(points_.size(), probe_point_blocks);
    Buffer scene(device, BufferUse::UniformOrStorage, std::max(scene_bytes, scene_.size() * sizeof(glm::vec4)),
                 "scene of a probe");
    Buffer nodes(device, BufferUse::Texels, std::max<std::size_t>(tree_nodes_.size(), 1) * sizeof(glm::uvec4),
                 "nodes of a probe");
    Buffer spheres(device, BufferUse::Texels, std::max<std::size_t>(tree_spheres_.size(), 1) * sizeof(glm::uvec4),
                   "spheres of a probe");
    Buffer points(device, BufferUse::Streamed, probe_point_blocks * sizeof(pt::PointBlock), "points of a probe");
    Buffer in(device, BufferUse::Storage, std::max<std::size_t>(input.size(), 16), "input of a probe");
    Buffer out(device, BufferUse::Storage, output.size() + guard_bytes, "output of a probe");
    out.upload(output, 0);
    in.upload(input, 0);
    scene.upload(std::as_bytes(std::span(scene_)), 0);
    nodes.upload(std::as_bytes(std::span(tree_nodes_)), 0);
    spheres.upload(std::as_bytes(std::span(tree_spheres_)), 0);
    points.upload(std::as_bytes(std::span(points_)), 0);
    std::vector<std::byte> guard(guard_bytes, guard_value);
    out.upload(guard, output.size());

    const std::array<pt::vulkan::BufferRange, 8> ranges = {scene, scene, out, in, points, nodes, spheres, in};
    const pt::vulkan::DescriptorSet set = pipeline_.bind(ranges);
    device.submit([&](const vk::raii::CommandBuffer &commands) {
        pipeline_.dispatch(commands, set, push, (invocations + workgroup_size - 1) / workgroup_size);
    });
    out.download(output, 0);
    out.download(guard, output.size());
    for (const std::byte value : guard)
        ASSERT_EQ(value, guard_value) << "the kernel wrote past its output";
}
