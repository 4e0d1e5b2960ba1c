#pragma once

#include <vulkan/vulkan_core.h>

namespace platform {

// NULL without a loader; module_error() has the reason.
PFN_vkGetInstanceProcAddr vulkan_functions();

} // namespace platform
