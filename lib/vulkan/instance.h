// The Vulkan instance, the library's own or the caller's.
#pragma once

#include "lib/base/log.h"
#include "lib/vulkan/api.h"

#include <memory>
#include <optional>
#include <vector>

namespace pt::vulkan {

class Instance {
public:
    // Throws PT_ERROR_NO_DEVICE without Vulkan or drivers, PT_ERROR_UNSUPPORTED without the validation layer.
    Instance(const Log &log, bool validation);

    // Does not own the caller's instance.
    Instance(const Log &log, VkInstance instance);
    Instance(Instance &&) noexcept = default;
    ~Instance() {
        if (!is_owned_)
            instance_.release();
    }

    const Log &log() const { return *log_; }

    const vk::raii::Instance &handle() const { return instance_; }

    // At least one; else throws PT_ERROR_NO_DEVICE.
    std::vector<vk::raii::PhysicalDevice> physical_devices() const;

    // Never destroys the Vulkan instance, which must outlive its devices.
    void abandon();

private:
    std::unique_ptr<const Log> log_; // the layer keeps its address, also during destruction
    vk::raii::Context context_;
    vk::raii::Instance instance_;
    bool is_owned_;
    std::optional<vk::raii::DebugUtilsMessengerEXT> messenger_;
};

} // namespace pt::vulkan
