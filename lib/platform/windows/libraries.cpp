#include "lib/platform/module.h"
#include "lib/platform/vulkan.h"

namespace platform {

const char *const denoiser_file = "OpenImageDenoise.dll";

PFN_vkGetInstanceProcAddr vulkan_functions() {
    static void *const loader = load_module("vulkan-1.dll");
    return loader ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(find_function(loader, "vkGetInstanceProcAddr"))
                  : nullptr;
}

} // namespace platform
