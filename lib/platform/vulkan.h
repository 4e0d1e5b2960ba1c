// The Vulkan loader.
#pragma once

#include <vulkan/vulkan_core.h>

namespace platform {

// NULL without a loader, with the reason in module_error().
PFN_vkGetInstanceProcAddr vulkan_functions();

} // namespace platform
