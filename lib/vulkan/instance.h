// The Vulkan instance, with the validation layer's messages going to the log. Made by Renderer and list_devices.
#pragma once

#include "api.h"
#include "log.h"

#include <optional>
#include <vector>

namespace pt::vulkan {

class Instance {
public:
    // The log must outlive the instance. Throws PT_ERROR_NO_DEVICE if Vulkan or its drivers are not there, and
    // PT_ERROR_UNSUPPORTED if validation is asked for and the layer is not installed.
    Instance(const Log &log, bool validation);

    // At least one; throws PT_ERROR_NO_DEVICE otherwise.
    std::vector<vk::raii::PhysicalDevice> physical_devices() const;

    // Leaves the Vulkan instance to the end of the process: one may not be destroyed while a device of it is there.
    void abandon();

private:
    vk::raii::Context context_;
    vk::raii::Instance instance_ = nullptr;
    std::optional<vk::raii::DebugUtilsMessengerEXT> messenger_;
};

} // namespace pt::vulkan
