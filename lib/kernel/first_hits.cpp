#include "lib/kernel/first_hits.h"

#include "lib/base/error.h"
#include "lib/film/pixel_format.h"
#include "lib/kernel/device_constants.h"
#include "lib/kernel/resolve.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <vector>

namespace pt {

namespace {

constexpr std::array first_hit_bindings = {
    vk::DescriptorType::eUniformBuffer,     vk::DescriptorType::eStorageBuffer, vulkan::no_binding,
    vk::DescriptorType::eStorageBuffer,     vk::DescriptorType::eStorageBuffer, vk::DescriptorType::eUniformTexelBuffer,
    vk::DescriptorType::eUniformTexelBuffer};
static_assert(gpu::BINDING_SCENE_UNIFORM == 0 && gpu::BINDING_SCENE_STORAGE == 1 && gpu::BINDING_RESOLVED == 3 &&
              gpu::BINDING_FINDINGS == 4 && gpu::BINDING_TREE_NODES == 5 && gpu::BINDING_TREE_SPHERES == 6);

// Little compared with the image in the caller's memory, and enough for one submission.
constexpr std::uint64_t most_first_hit_pixels = 1U << 18;

gpu::FirstHitConstants first_hit_constants(const GpuScene &scene) {
    gpu::FirstHitConstants constants{};
    constants.camera = scene.frame.camera;
    constants.start_distance = static_cast<float>(scene.start_distance);
    return constants;
}

} // namespace

FirstHits::FirstHits(vulkan::Device &device, std::span<const std::uint32_t> code) :
    device_(device),
    kernel_(device, {code, first_hit_bindings, sizeof(gpu::FirstHitConstants)}) {}

void FirstHits::show(const std::shared_ptr<const GpuScene> &scene, const vulkan::Buffer *tree) {
    if (kernel_.shows(scene))
        return;
    slot_.reset(); // bound to the scene before
    auto specialization = specialization_constants(scene->features);
    set_device_constants(specialization, device_.policy());
    kernel_.show(scene, tree, specialization);
    constants_ = first_hit_constants(*scene);
}

// As many as one submission should take and the buffers can hold.
std::uint64_t FirstHits::pixels_in_piece(const FirstHitQuery &query, double tests_per_submission) const {
    const std::uint32_t rays = gpu::rays_of_pixel(query.quantity);
    const std::uint64_t dispatched = std::uint64_t{device_.limits().max_workgroup_count} * gpu::WORKGROUP_SIZE / rays;
    const auto worth = static_cast<std::uint64_t>(kernel_.rays_for(tests_per_submission)) / rays;
    const std::uint64_t affordable = std::max<std::uint64_t>(worth, gpu::WORKGROUP_SIZE);
    return std::min({affordable, dispatched, most_first_hit_pixels, query.pixels.pixel_count()});
}

FirstHits::Slot &FirstHits::slot(std::uint64_t bytes) {
    if (slot_ && slot_->found.size() >= bytes)
        return *slot_;
    using enum vulkan::BufferUse;
    slot_.reset();
    Slot made{{device_, Storage, bytes, "first hits"},
              {device_, Storage, findings_bytes, "findings of first hits"},
              {device_, HostRead, findings_bytes + bytes, "first hits"},
              {}};
    std::array<vulkan::BufferRange, first_hit_bindings.size()> ranges;
    kernel_.bind_scene(ranges);
    ranges[gpu::BINDING_RESOLVED] = vulkan::BufferRange(made.found);
    ranges[gpu::BINDING_FINDINGS] = vulkan::BufferRange(made.findings);
    made.set = kernel_.pipeline().bind(ranges);
    return slot_.emplace(std::move(made));
}

void FirstHits::read(const FirstHitQuery &query, double tests_per_submission, const Receive &receive) {
    const std::uint64_t most = pixels_in_piece(query, tests_per_submission);
    const std::uint64_t bytes_of_pixel = pixel_bytes(query.format);
    const Slot &slot = this->slot(most * bytes_of_pixel);
    gpu::FirstHitConstants constants = constants_;
    constants.quantity = query.quantity;
    constants.format = query.format;
    constants.first_pixel = query.pixels.y * constants.camera.width + query.pixels.x;
    constants.rectangle_width = query.pixels.width;
    for (std::uint64_t done = 0, total = query.pixels.pixel_count(); done < total; done += constants.pixel_count) {
        constants.first_of_rectangle = static_cast<std::uint32_t>(done);
        constants.pixel_count = static_cast<std::uint32_t>(std::min(most, total - done));
        const std::uint64_t bytes = constants.pixel_count * bytes_of_pixel;
        device_.submit([&](const auto &commands) { record(commands, slot, constants, bytes); });
        const std::span<const std::byte> found = slot.host.host_bytes();
        std::uint32_t lost_pixels = 0;
        std::memcpy(&lost_pixels, found.data(), sizeof lost_pixels);
        if (lost_pixels > 0)
            throw Error(PT_ERROR_INTERNAL,
                        "the driver stopped " + std::to_string(lost_pixels) + " rays before they had met anything");
        receive(found.subspan(findings_bytes, bytes));
    }
}

void FirstHits::record(const vk::raii::CommandBuffer &commands, const Slot &slot,
                       const gpu::FirstHitConstants &constants, std::uint64_t bytes) const {
    const std::uint32_t rays = constants.pixel_count * gpu::rays_of_pixel(constants.quantity);
    slot.findings.clear(commands, 0, findings_bytes);
    vulkan::barrier_between_commands(commands);
    kernel_.pipeline().dispatch(commands, slot.set, std::as_bytes(std::span(&constants, 1)),
                                (rays + gpu::WORKGROUP_SIZE - 1) / gpu::WORKGROUP_SIZE);
    vulkan::barrier_between_commands(commands);
    slot.host.copy(commands, slot.findings, findings_bytes);
    slot.host.copy(commands, slot.found, bytes, findings_bytes);
}

} // namespace pt
