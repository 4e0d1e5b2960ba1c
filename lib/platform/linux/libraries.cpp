#include "lib/platform/vulkan.h"

#include "lib/platform/module.h"

namespace platform {

const char *const denoiser_file = "libOpenImageDenoise.so.2";

// Programs are linked with the loader.
PFN_vkGetInstanceProcAddr vulkan_functions() {
    return &::vkGetInstanceProcAddr;
}

} // namespace platform
