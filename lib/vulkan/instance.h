#pragma once

#include "lib/base/log.h"
#include "lib/vulkan/api.h"

#include <memory>
#include <optional>
#include <vector>

namespace pt::vulkan {

class Instance {
public:
    // Throws PT_ERROR_NO_DEVICE without Vulkan or drivers, or PT_ERROR_UNSUPPORTED without the validation layer.
    Instance(const Log &log, bool validation);

    Instance(const Log &log, VkInstance instance);
    Instance(Instance &&) noexcept = default;
    ~Instance() {
        if (!is_owned_)
            instance_.release();
    }

    const Log &log() const { return *log_; }

    const vk::raii::Instance &handle() const { return instance_; }

    std::vector<vk::raii::PhysicalDevice> physical_devices() const;

    // The instance will not be destroyed, because a hanging device needs it.
    void abandon();

private:
    std::unique_ptr<const Log> log_; // the validation layer uses this address until destruction
    vk::raii::Context context_;
    vk::raii::Instance instance_;
    bool is_owned_;
    std::optional<vk::raii::DebugUtilsMessengerEXT> messenger_;
};

} // namespace pt::vulkan
