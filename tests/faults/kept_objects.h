// Vulkan's instance, devices and pipelines, kept from life to life: the library creates and destroys them as usual, but
// the driver, which takes a quarter of a second for that, makes each only once.
#pragma once

#include <vulkan/vulkan_core.h>

namespace faults {

VkResult kept_instance(PFN_vkCreateInstance create, const VkInstanceCreateInfo *info, VkInstance *instance);

// One that is not in use.
VkResult kept_device(PFN_vkCreateDevice create, VkPhysicalDevice physical_device, const VkDeviceCreateInfo *info,
                     VkDevice *device);
void put_back(VkDevice device);
void put_all_back();

// Pipelines are the same if their device, code and constants are.
void note_code(VkShaderModule module, const VkShaderModuleCreateInfo *info);
VkResult kept_pipeline(PFN_vkCreateComputePipelines create, VkDevice device, const VkComputePipelineCreateInfo *info,
                       VkPipeline *pipeline);

} // namespace faults
