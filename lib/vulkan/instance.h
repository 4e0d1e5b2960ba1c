// The Vulkan instance: the library's own, with the validation layer's messages going to the log, or the caller's.
#pragma once

#include "lib/base/log.h"
#include "lib/vulkan/api.h"

#include <memory>
#include <optional>
#include <vector>

namespace pt::vulkan {

class Instance {
public:
    // Throws PT_ERROR_NO_DEVICE if Vulkan or its drivers are not there, and
    // PT_ERROR_UNSUPPORTED if validation is asked for and the layer is not installed.
    Instance(const Log &log, bool validation);

    // The caller's, which is left alone.
    Instance(const Log &log, VkInstance instance);
    Instance(Instance &&) noexcept = default;
    ~Instance() {
        if (!is_owned_)
            instance_.release();
    }

    const Log &log() const { return *log_; }

    const vk::raii::Instance &handle() const { return instance_; }

    // At least one; throws PT_ERROR_NO_DEVICE otherwise.
    std::vector<vk::raii::PhysicalDevice> physical_devices() const;

    // From now on the Vulkan instance is never destroyed, whoever made it: it must not be while one of its devices
    // exists.
    void abandon();

private:
    std::unique_ptr<const Log> log_; // the layer has its address, also while the Vulkan instance is destroyed
    vk::raii::Context context_;
    vk::raii::Instance instance_;
    bool is_owned_; // else it is left alone
    std::optional<vk::raii::DebugUtilsMessengerEXT> messenger_;
};

} // namespace pt::vulkan
