#include "lib/platform/module.h"
#include "lib/platform/vulkan.h"

namespace platform {

const char *const denoiser_file = "libOpenImageDenoise.2.dylib";

// Loads the Vulkan loader on demand, so that a message can say what to install. MoltenVK is a driver that needs no
// loader.
PFN_vkGetInstanceProcAddr vulkan_functions() {
    static void *const loader = [] {
        void *const vulkan = load_module("libvulkan.1.dylib");
        return vulkan ? vulkan : load_module("libMoltenVK.dylib");
    }();
    return loader ? reinterpret_cast<PFN_vkGetInstanceProcAddr>(find_function(loader, "vkGetInstanceProcAddr"))
                  : nullptr;
}

} // namespace platform
