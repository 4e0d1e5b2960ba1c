#include "lib/platform/vulkan.h"

#include "lib/platform/module.h"

namespace platform {

const char *const denoiser_file = "libOpenImageDenoise.so.2";

// On Linux programs are linked with the Vulkan loader.
PFN_vkGetInstanceProcAddr vulkan_functions() {
    return &::vkGetInstanceProcAddr;
}

} // namespace platform
