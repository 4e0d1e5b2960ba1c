// Work that a device cannot finish before the test allows it, however fast the device and slow the test.
#pragma once

#include "lib/vulkan/api.h"

class Gate {
public:
    // The device must outlive it.
    explicit Gate(const vk::raii::Device &device) : device_(device), event_(device.createEvent({})) {}
    ~Gate() { open(); }
    Gate(const Gate &) = delete;
    Gate &operator=(const Gate &) = delete;

    // What is recorded after it waits for open().
    void record(const vk::raii::CommandBuffer &commands) const {
        commands.waitEvents(*event_, vk::PipelineStageFlagBits::eHost, vk::PipelineStageFlagBits::eComputeShader, {},
                            {}, {});
    }

    // Returns when the work has ended.
    void open() const {
        event_.set();
        device_.waitIdle();
    }

private:
    const vk::raii::Device &device_;
    vk::raii::Event event_;
};
