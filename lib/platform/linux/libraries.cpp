#include "lib/platform/vulkan.h"

#include "lib/platform/module.h"

namespace platform {

const char *const denoiser_file = "libOpenImageDenoise.so.2";

PFN_vkGetInstanceProcAddr vulkan_functions() {
    return &::vkGetInstanceProcAddr;
}

} // namespace platform
