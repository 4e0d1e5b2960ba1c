#include "lib/vulkan/compute_pipeline.h"

#include "lib/base/error.h"
#include "lib/base/spirv.h"
#include "lib/vulkan/result.h"

#include <algorithm>
#include <set>
#include <string>

namespace pt::vulkan {

namespace {

vk::raii::DescriptorSetLayout create_set_layout(const Device &device, std::span<const Binding> bindings) {
    std::vector<vk::DescriptorSetLayoutBinding> described;
    for (const Binding &binding : bindings)
        described.push_back({.binding = binding.number,
                             .descriptorType = binding.type,
                             .descriptorCount = 1,
                             .stageFlags = vk::ShaderStageFlagBits::eCompute});
    return device.handle().createDescriptorSetLayout(
        {.bindingCount = static_cast<std::uint32_t>(described.size()), .pBindings = described.data()});
}

// Edited kernels (pt_create_info.shader_dir) may have wrong bindings, which drivers accept.
void require_bindings(std::span<const std::uint32_t> spirv, std::span<const Binding> bindings) {
    spirv::for_each_instruction(spirv, spirv::header_words, [&](spirv::Words instruction, std::size_t) {
        if (spirv::opcode_of(instruction) != spirv::OpDecorate)
            return true;
        const bool names_set = instruction[2] == spirv::decoration_descriptor_set && instruction[3] != 0;
        const bool names_binding = instruction[2] == spirv::decoration_binding &&
                                   std::ranges::find(bindings, instruction[3], &Binding::number) == bindings.end();
        if (names_set || names_binding) {
            std::set<std::uint32_t> numbers;
            for (const Binding &binding : bindings)
                numbers.insert(binding.number);
            std::string known;
            for (const std::uint32_t number : numbers)
                known += (known.empty() ? "" : ", ") + std::to_string(number);
            throw Error(PT_ERROR_SHADER, std::string("building a kernel: ") + (names_set ? "set " : "binding ") +
                                             std::to_string(instruction[3]) +
                                             " is not in its layout, which has the bindings " + known + " of set 0");
        }
        return true;
    });
}

vk::raii::Pipeline create_pipeline(Device &device, const vk::raii::PipelineLayout &layout,
                                   std::span<const std::uint32_t> spirv, std::span<const std::uint32_t> constants) {
    const vk::raii::ShaderModule module =
        device.handle().createShaderModule({.codeSize = spirv.size_bytes(), .pCode = spirv.data()});
    std::vector<vk::SpecializationMapEntry> entries;
    for (std::uint32_t i = 0; i < constants.size(); ++i)
        entries.push_back({.constantID = i, .offset = 4 * i, .size = 4});
    const vk::SpecializationInfo specialization{.mapEntryCount = static_cast<std::uint32_t>(entries.size()),
                                                .pMapEntries = entries.data(),
                                                .dataSize = constants.size_bytes(),
                                                .pData = constants.data()};
    const vk::PipelineShaderStageCreateInfo stage{.stage = vk::ShaderStageFlagBits::eCompute,
                                                  .module = *module,
                                                  .pName = "main",
                                                  .pSpecializationInfo = &specialization};
    try {
        PipelineCache &cache = device.pipeline_cache();
        vk::raii::Pipeline pipeline =
            device.handle().createComputePipeline(cache.handle(), {.stage = stage, .layout = *layout});
        cache.note_kernel();
        return pipeline;
    } catch (const vk::SystemError &error) {
        const pt_result result = result_of(static_cast<vk::Result>(error.code().value()));
        // Drivers return these results for invalid kernels.
        throw Error(result == PT_ERROR_INTERNAL || result == PT_ERROR_NO_DEVICE ? PT_ERROR_SHADER : result,
                    std::string("building a kernel: ") + error.what());
    }
}

} // namespace

ComputePipeline::ComputePipeline(Device &device, std::span<const std::uint32_t> spirv,
                                 std::span<const Binding> bindings, std::uint32_t push_constant_bytes,
                                 std::span<const std::uint32_t> constants) :
    device_(&device),
    bindings_(bindings.begin(), bindings.end()) {
    device.require_alive();
    require_bindings(spirv, bindings);
    translated("building a kernel", [&] {
        set_layout_ = {device, create_set_layout(device, bindings)};
        const vk::DescriptorSetLayout set_layout = *set_layout_;
        const vk::PushConstantRange push{.stageFlags = vk::ShaderStageFlagBits::eCompute, .size = push_constant_bytes};
        layout_ = {device,
                   device.handle().createPipelineLayout({.setLayoutCount = 1,
                                                         .pSetLayouts = &set_layout,
                                                         .pushConstantRangeCount = push_constant_bytes > 0 ? 1U : 0U,
                                                         .pPushConstantRanges = &push})};
        pipeline_ = {device, create_pipeline(device, layout_.get(), spirv, constants)};
    });
}

DescriptorSet ComputePipeline::bind(std::span<const BufferRange> ranges) const {
    return translated("binding buffers", [&] {
        std::vector<vk::DescriptorPoolSize> sizes;
        for (const Binding &binding : bindings_)
            sizes.push_back({.type = binding.type, .descriptorCount = 1});
        DescriptorSet set;
        set.pool_ = {
            *device_,
            device_->handle().createDescriptorPool(
                {.maxSets = 1, .poolSizeCount = static_cast<std::uint32_t>(sizes.size()), .pPoolSizes = sizes.data()})};
        const vk::DescriptorSetLayout layout = *set_layout_;
        set.set_ = device_->handle()
                       .allocateDescriptorSets(
                           {.descriptorPool = *set.pool_, .descriptorSetCount = 1, .pSetLayouts = &layout})[0]
                       .release();
        for (std::size_t i = 0; i < bindings_.size(); ++i) {
            const auto [number, type] = bindings_[i];
            const bool uniform =
                type == vk::DescriptorType::eUniformBuffer || type == vk::DescriptorType::eUniformBufferDynamic;
            if (type == vk::DescriptorType::eUniformTexelBuffer)
                set.views_.emplace_back(*device_, device_->handle().createBufferView({.buffer = ranges[i].buffer,
                                                                                      .format = texel_format,
                                                                                      .offset = ranges[i].offset,
                                                                                      .range = ranges[i].bytes}));
            const vk::BufferView view = set.views_.empty() ? vk::BufferView() : *set.views_.back();
            const std::uint64_t most = uniform ? device_->limits().max_uniform_range : ranges[i].bytes;
            const vk::DescriptorBufferInfo info{
                .buffer = ranges[i].buffer, .offset = ranges[i].offset, .range = std::min(most, ranges[i].bytes)};
            device_->handle().updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = set.set_,
                                                                          .dstBinding = number,
                                                                          .descriptorCount = 1,
                                                                          .descriptorType = type,
                                                                          .pBufferInfo = &info,
                                                                          .pTexelBufferView = &view},
                                                   {});
        }
        return set;
    });
}

void ComputePipeline::dispatch(const vk::raii::CommandBuffer &commands, const DescriptorSet &set,
                               std::span<const std::byte> push_constants, std::uint32_t group_count,
                               std::span<const std::uint32_t> offsets, std::uint32_t rows) const {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, set.handle(), offsets);
    if (!push_constants.empty())
        commands.pushConstants<std::byte>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, push_constants);
    commands.dispatch(group_count, rows, 1);
}

} // namespace pt::vulkan
