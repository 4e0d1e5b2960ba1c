#pragma once

#include "lib/vulkan/api.h"

class HeldWork {
public:
    explicit HeldWork(const vk::raii::Device &device) : device_(device), event_(device.createEvent({})) {}
    ~HeldWork() { open(); }
    HeldWork(const HeldWork &) = delete;
    HeldWork &operator=(const HeldWork &) = delete;

    void record(const vk::raii::CommandBuffer &commands) const {
        commands.waitEvents(*event_, vk::PipelineStageFlagBits::eHost, vk::PipelineStageFlagBits::eComputeShader, {},
                            {}, {});
    }

    void open() const {
        event_.set();
        device_.waitIdle();
    }

private:
    const vk::raii::Device &device_;
    vk::raii::Event event_;
};
