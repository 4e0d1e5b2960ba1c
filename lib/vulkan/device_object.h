#pragma once

#include "lib/vulkan/device.h"

#include <utility>

namespace pt::vulkan {

// Owns a Vulkan object. If the device hangs, the object is not destroyed, because running work may use it (Vulkan,
// "Object Lifetime").
template <typename Object>
class DeviceObject {
public:
    DeviceObject() = default;
    DeviceObject(const Device &device, Object object) : device_(&device), object_(std::move(object)) {}
    DeviceObject(DeviceObject &&) noexcept = default;
    DeviceObject &operator=(DeviceObject &&other) noexcept {
        std::swap(device_, other.device_);
        std::swap(object_, other.object_);
        return *this;
    }
    ~DeviceObject() {
        if (device_ && device_->hangs())
            object_.release();
    }

    const Object &get() const { return object_; }
    auto operator*() const { return *object_; }
    const Object *operator->() const { return &object_; }

private:
    const Device *device_ = nullptr;
    Object object_ = nullptr;
};

} // namespace pt::vulkan
