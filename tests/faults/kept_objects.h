#pragma once

#include <vulkan/vulkan_core.h>

namespace faults {

VkResult kept_instance(PFN_vkCreateInstance create, const VkInstanceCreateInfo *info, VkInstance *instance);

VkResult kept_device(PFN_vkCreateDevice create, VkPhysicalDevice physical_device, const VkDeviceCreateInfo *info,
                     VkDevice *device);
void put_back(VkDevice device);
void put_all_back();

void note_code(VkShaderModule module, const VkShaderModuleCreateInfo *info);
VkResult kept_pipeline(PFN_vkCreateComputePipelines create, VkDevice device, const VkComputePipelineCreateInfo *info,
                       VkPipeline *pipeline);

} // namespace faults
