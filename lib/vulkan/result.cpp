#include "lib/vulkan/result.h"

#include <string>

namespace pt::vulkan {

pt_result result_of(vk::Result result) {
    switch (result) {
    case vk::Result::eErrorOutOfHostMemory:
    case vk::Result::eErrorMemoryMapFailed:
        return PT_ERROR_OUT_OF_HOST_MEMORY;
    case vk::Result::eErrorOutOfDeviceMemory:
    case vk::Result::eErrorFragmentation:
    case vk::Result::eErrorFragmentedPool:
    case vk::Result::eErrorOutOfPoolMemory:
    case vk::Result::eErrorTooManyObjects:
        return PT_ERROR_OUT_OF_DEVICE_MEMORY;
    case vk::Result::eErrorDeviceLost:
        return PT_ERROR_DEVICE_LOST;
    case vk::Result::eErrorInvalidShaderNV:
        return PT_ERROR_SHADER;
    case vk::Result::eErrorIncompatibleDriver:
    case vk::Result::eErrorInitializationFailed:
        return PT_ERROR_NO_DEVICE;
    case vk::Result::eErrorLayerNotPresent:
    case vk::Result::eErrorExtensionNotPresent:
    case vk::Result::eErrorFeatureNotPresent:
        return PT_ERROR_UNSUPPORTED;
    default:
        return PT_ERROR_INTERNAL;
    }
}

void throw_translated(const vk::SystemError &error, std::string_view what_was_being_done) {
    const auto result = static_cast<vk::Result>(error.code().value());
    throw Error(result_of(result), std::string(what_was_being_done) + ": " + vk::to_string(result));
}

} // namespace pt::vulkan
