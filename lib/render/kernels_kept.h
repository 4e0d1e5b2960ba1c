// Hands to the caller, at the end of a call, the kernels that were built in it. Used by Renderer.
#pragma once

#include "lib/render/render_device.h"

#include <memory>
#include <vector>

namespace pt {

class KernelsKept {
public:
    explicit KernelsKept(const std::vector<std::unique_ptr<RenderDevice>> &devices) : devices_(devices) {}
    KernelsKept(const KernelsKept &) = delete;
    KernelsKept &operator=(const KernelsKept &) = delete;
    ~KernelsKept() {
        for (const auto &device : devices_)
            device->save_kernels();
    }

private:
    const std::vector<std::unique_ptr<RenderDevice>> &devices_;
};

} // namespace pt
