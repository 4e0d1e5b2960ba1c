// Specialises the kernels; see trace_pipelines.h.
#include "lib/kernel/trace_pipelines.h"

#include "shaders/gpu_layout.h"

#include <array>
#include <bit>
#include <chrono>
#include <string>
#include <utility>

namespace pt {

namespace {

constexpr std::array bindings = {vk::DescriptorType::eUniformBuffer, vk::DescriptorType::eStorageBuffer,
                                 vk::DescriptorType::eStorageBuffer, vk::DescriptorType::eStorageBuffer,
                                 vk::DescriptorType::eUniformBufferDynamic};

// A kernel for one scene takes about 0.3 s to build and then saves about a third of the time, so that it pays after a
// second. Waiting just that long costs at most twice what knowing the future would (the ski rental problem).
constexpr double seconds_before_own_kernel = 1.0;

std::vector<std::uint32_t> constants_of_features(const vulkan::Device &device, const Features &features,
                                                 std::uint32_t sharers) {
    const auto constants = specialization_constants(features);
    std::vector<std::uint32_t> result(constants.begin(), constants.end());
    result[gpu::ID_POINT_BLOCKS] = device.limits().max_uniform_range / std::uint32_t{sizeof(glm::uvec4)};
    result[gpu::ID_SHARERS] = sharers;
    result[gpu::ID_OVERLAP] = device.policy().invocations > 0 ? 1 : 0;
    return result;
}

std::vector<std::uint32_t> with_scene(std::vector<std::uint32_t> constants, std::span<const glm::vec4> words) {
    constants[gpu::ID_SCENE_SOURCE] = gpu::SCENE_IN_CONSTANTS;
    for (const glm::vec4 &word : words)
        for (int i = 0; i < 4; ++i)
            constants.push_back(std::bit_cast<std::uint32_t>(word[i]));
    return constants;
}

} // namespace

const vulkan::ComputePipeline &TracePipelines::build(std::optional<Specialised> &place,
                                                     std::vector<std::uint32_t> constants) {
    using Clock = std::chrono::steady_clock;
    place.reset(); // leaves it empty if the new one cannot be built
    const Clock::time_point start = Clock::now();
    vulkan::ComputePipeline pipeline(device_, code_.pathtrace, bindings, sizeof(gpu::FrameConstants), constants);
    device_.log().info([&] {
        const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start).count();
        const bool own = constants[gpu::ID_SCENE_SOURCE] == gpu::SCENE_IN_CONSTANTS;
        return std::string("built a kernel for ") + (own ? "this scene alone" : "all scenes of this kind") + " in " +
               std::to_string(milliseconds) + " ms";
    });
    return place.emplace(Specialised{std::move(constants), std::move(pipeline)}).pipeline;
}

const vulkan::ComputePipeline &TracePipelines::trace(const Features &features, std::uint32_t sharers,
                                                     std::span<const glm::vec4> words, double seconds) {
    const vulkan::ComputePipeline &pipeline = find_or_build(features, sharers, words, seconds);
    features_ = features;
    return pipeline;
}

const vulkan::ComputePipeline &TracePipelines::find_or_build(const Features &features, std::uint32_t sharers,
                                                             std::span<const glm::vec4> words, double seconds) {
    const bool same_features = features_ == features;
    std::vector<std::uint32_t> constants = constants_of_features(device_, features, sharers);
    if (device_.policy().scene_in_constants && words.size() <= gpu::CONSTANT_SCENE_WORDS) {
        std::vector<std::uint32_t> own = with_scene(constants, words);
        if (one_scene_ && one_scene_->constants == own)
            return one_scene_->pipeline;
        if (!same_features || seconds > seconds_before_own_kernel)
            return build(one_scene_, std::move(own));
    }
    if (any_scene_ && any_scene_->constants == constants)
        return any_scene_->pipeline;
    return build(any_scene_, std::move(constants));
}

const vulkan::ComputePipeline &TracePipelines::commit() {
    if (!commit_)
        commit_.emplace(device_, code_.commit, bindings, sizeof(gpu::FrameConstants), std::span<const std::uint32_t>{});
    return *commit_;
}

const vulkan::ComputePipeline &TracePipelines::fold() {
    if (!fold_)
        fold_.emplace(device_, code_.fold, bindings, sizeof(gpu::FrameConstants), std::span<const std::uint32_t>{});
    return *fold_;
}

} // namespace pt
