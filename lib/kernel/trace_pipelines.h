// The specialised pipelines of pathtrace.comp, and the one of fold.comp, kept from scene to scene.
// Owned by RenderDevice, used by Kernel.
#pragma once

#include "lib/kernel/own_kernel_clock.h"
#include "lib/kernel/scene_features.h"
#include "lib/kernel/shader_source.h"
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

// All pipelines have the same bindings, so one descriptor set serves for all.
class TracePipelines {
public:
    // How many kernels of pathtrace.comp are kept: for lamps switched on and off, a sphere more or less, a camera
    // inside a ball and outside, each perhaps with a kernel for one scene. Work under way uses at most the last two.
    static constexpr std::size_t most_kept = 8;

    // The device must outlive the pipelines.
    explicit TracePipelines(vulkan::Device &device, KernelCode code = embedded_code());

    // The key under which the driver's kernels for this code and device are kept. It can be taken once; that never
    // fails.
    std::string take_kernel_key() noexcept { return std::move(kernel_key_); }

    // The kernel for scenes with these features or, where that is faster, one for this scene alone. Both give the same
    // bits. The first scene gets one of its own at once, as it has to wait for some kernel anyway; others get one once
    // they have been rendered for a while (own_kernel_clock.h), since building takes as long as many small images do.
    // words: the scene buffer; seconds: how long this scene has been rendered so far without a change of it or of the
    // camera. The reference holds until the next call.
    const vulkan::ComputePipeline &trace(const Features &features, std::span<const glm::vec4> words, double seconds);

    // From now on scenes get kernels of their own when these pay; or every scene at once, for whoever prepares kernels
    // ahead and has the time; or no scene, since polls build nothing.
    enum class OwnKernels { when_they_pay, at_once, never };
    void build_own(OwnKernels when) { own_kernels_ = when; }

    // The kernel that adds one part of the film to the other.
    const vulkan::ComputePipeline &fold();

private:
    // A pipeline, and the constants that it is specialised to.
    struct Specialised {
        std::vector<std::uint32_t> constants;
        vulkan::ComputePipeline pipeline;
    };

    // The last kernel that was built for one scene alone.
    struct OwnKernel {
        std::vector<std::uint32_t> constants;
        double last_seconds; // of the scene
        double used_seconds; // since the kernel was built
    };

    const vulkan::ComputePipeline *find(const std::vector<std::uint32_t> &constants);
    const vulkan::ComputePipeline &build(std::vector<std::uint32_t> constants);
    void note_own(const std::vector<std::uint32_t> &constants, double seconds);

    vulkan::Device &device_;
    KernelCode code_;
    std::string kernel_key_;
    std::list<Specialised> kept_; // the last used first
    OwnKernelClock clock_;
    std::optional<OwnKernel> own_;
    OwnKernels own_kernels_ = OwnKernels::when_they_pay;
    std::optional<vulkan::ComputePipeline> fold_;
};

} // namespace pt
