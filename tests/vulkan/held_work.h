#pragma once

#include "lib/vulkan/api.h"

class Gate {
public:
    explicit Gate(const vk::raii::Device &device) : device_(device), event_(device.createEvent({})) {}
    ~Gate() { open(); }
    Gate(const Gate &) = delete;
    Gate &operator=(const Gate &) = delete;

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
