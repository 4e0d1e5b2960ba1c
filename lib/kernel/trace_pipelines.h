// The specialised pipelines of pathtrace.comp, and those of commit.comp and fold.comp, kept from scene to scene.
// Owned by RenderDevice, used by Kernel.
#pragma once

#include "lib/kernel/scene_features.h"
#include "lib/kernel/shader_source.h"
#include "lib/vulkan/compute_pipeline.h"
#include "lib/vulkan/device.h"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pt {

// All have the same bindings, so a descriptor set of one does for the others.
class TracePipelines {
public:
    // The device must outlive the pipelines.
    explicit TracePipelines(vulkan::Device &device, KernelCode code = embedded_code()) :
        device_(device),
        code_(std::move(code)) {}

    // The kernel for scenes with these features, or where that is faster for this scene alone: building takes as long
    // as many small images do, so a scene that took the place of one with the same features gets a kernel of its own
    // only after it has been rendered for a while. Both give the same bits. sharers: invocations to a pixel; words: the
    // scene buffer; seconds: for which this scene has been rendered so far. The reference holds until the next call.
    const vulkan::ComputePipeline &trace(const Features &features, std::uint32_t sharers,
                                         std::span<const glm::vec4> words, double seconds);

    // The kernel that adds a split pass to the film.
    const vulkan::ComputePipeline &commit();

    // The kernel that adds one part of the film to the other.
    const vulkan::ComputePipeline &fold();

private:
    // A pipeline and what it is specialised to.
    struct Specialised {
        std::vector<std::uint32_t> constants;
        vulkan::ComputePipeline pipeline;
    };

    const vulkan::ComputePipeline &find_or_build(const Features &features, std::uint32_t sharers,
                                                 std::span<const glm::vec4> words, double seconds);
    const vulkan::ComputePipeline &build(std::optional<Specialised> &place, std::vector<std::uint32_t> constants);

    vulkan::Device &device_;
    KernelCode code_;
    std::optional<Features> features_;     // of the kernel that was asked for last
    std::optional<Specialised> any_scene_; // reads the scene from a buffer
    std::optional<Specialised> one_scene_; // has the scene's numbers as constants
    std::optional<vulkan::ComputePipeline> commit_;
    std::optional<vulkan::ComputePipeline> fold_;
};

} // namespace pt
