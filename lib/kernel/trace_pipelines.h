#pragma once

#include "lib/code/own_kernel_clock.h"
#include "lib/code/shader_source.h"
#include "lib/view/scene_features.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"

#include <cstddef>
#include <cstdint>
#include <list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pt {

class TracePipelines {
public:
    // Largest number of pipelines that are kept. Running work uses at most the last two.
    static constexpr std::size_t most_kept = 8;

    explicit TracePipelines(vulkan::Device &device, KernelCode code = embedded_code());

    // Returns the key of the driver's cache. May be called once.
    std::string take_kernel_key() noexcept { return std::move(kernel_key_); }

    // Returns the kernel for these features or, if faster, a kernel for this scene alone. Both compute the same bits.
    // The first scene gets its own kernel at once, because a kernel must be built anyway. Later scenes wait
    // (own_kernel_clock.h). `words` is the scene buffer. `seconds` is the time spent on this scene. The result is valid
    // until the next call.
    const vulkan::ComputePipeline &trace(const Features &features, std::span<const glm::vec4> words, double seconds);

    // at_once: when kernels are prepared ahead; never: in polls, which must not build.
    enum class OwnKernels { when_they_pay, at_once, never };
    void build_own(OwnKernels when) { own_kernels_ = when; }

    const vulkan::ComputePipeline &fold();

private:
    struct Specialised {
        std::vector<std::uint32_t> constants;
        vulkan::ComputePipeline pipeline;
    };

    struct OwnKernel {
        std::vector<std::uint32_t> constants;
        double last_seconds;
        double used_seconds;
    };

    const vulkan::ComputePipeline *find(const std::vector<std::uint32_t> &constants);
    const vulkan::ComputePipeline &build(std::vector<std::uint32_t> constants);
    void note_own(const std::vector<std::uint32_t> &constants, double seconds);

    vulkan::Device &device_;
    KernelCode code_;
    std::string kernel_key_;
    std::list<Specialised> kept_;
    OwnKernelClock clock_;
    std::optional<OwnKernel> own_;
    OwnKernels own_kernels_ = OwnKernels::when_they_pay;
    std::optional<vulkan::ComputePipeline> fold_;
};

} // namespace pt
