#include "tests/faults/kept_objects.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace faults {

namespace {

struct KeptDevice {
    VkDevice device;
    bool in_use;
};

VkInstance the_instance = VK_NULL_HANDLE;
std::vector<KeptDevice> devices;
std::map<VkShaderModule, std::string> codes;
std::map<std::tuple<VkDevice, std::string, std::string>, VkPipeline> pipelines;

} // namespace

VkResult kept_instance(PFN_vkCreateInstance create, const VkInstanceCreateInfo *info, VkInstance *instance) {
    const VkResult result = the_instance ? VK_SUCCESS : create(info, nullptr, &the_instance);
    *instance = the_instance;
    return result;
}

VkResult kept_device(PFN_vkCreateDevice create, VkPhysicalDevice physical_device, const VkDeviceCreateInfo *info,
                     VkDevice *device) {
    const auto free = std::ranges::find(devices, false, &KeptDevice::in_use);
    if (free != devices.end()) {
        free->in_use = true;
        *device = free->device;
        return VK_SUCCESS;
    }
    const VkResult result = create(physical_device, info, nullptr, device);
    if (result == VK_SUCCESS)
        devices.push_back({*device, true});
    return result;
}

void put_back(VkDevice device) {
    std::ranges::find(devices, device, &KeptDevice::device)->in_use = false;
}

void put_all_back() {
    for (KeptDevice &device : devices)
        device.in_use = false;
}

void note_code(VkShaderModule module, const VkShaderModuleCreateInfo *info) {
    codes[module] = std::string(reinterpret_cast<const char *>(info->pCode), info->codeSize);
}

VkResult kept_pipeline(PFN_vkCreateComputePipelines create, VkDevice device, const VkComputePipelineCreateInfo *info,
                       VkPipeline *pipeline) {
    const VkSpecializationInfo *constants = info->stage.pSpecializationInfo;
    const std::string values(static_cast<const char *>(constants->pData), constants->dataSize);
    VkPipeline &kept = pipelines[{device, codes.at(info->stage.module), values}];
    const VkResult result = kept ? VK_SUCCESS : create(device, VK_NULL_HANDLE, 1, info, nullptr, &kept);
    *pipeline = kept;
    return result;
}

} // namespace faults
