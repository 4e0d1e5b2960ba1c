// The Vulkan loader.
#pragma once

#include <vulkan/vulkan_core.h>

namespace platform {

// NULL if there is no loader; module_error() then says why.
PFN_vkGetInstanceProcAddr vulkan_functions();

} // namespace platform
