#include "lib/kernel/trace_pipelines.h"

#include "lib/code/specialised_pipeline.h"
#include "lib/kernel/scene_kernel.h"
#include "lib/view/scene_blocks.h"
#include "shaders/specialization.h"

#include <algorithm>
#include <bit>
#include <chrono>

namespace pt {

namespace {

std::vector<vulkan::Binding> trace_bindings() {
    return with_scene_bindings(
        {{gpu::BINDING_FILM}, {gpu::BINDING_POINTS, vk::DescriptorType::eUniformBufferDynamic}, {gpu::BINDING_TILES}});
}

std::vector<std::uint32_t> constants_of_features(const vulkan::Device &device, const Features &features) {
    const auto constants = specialization_constants(features);
    std::vector<std::uint32_t> result(constants.begin(), constants.end());
    set_device_constants(result, device);
    result[gpu::ID_WALK_TRIPS] = features[gpu::ID_TREE] ? device.policy().walk_trips : 0;
    const bool fits = SceneBlocks(features).word_count <= gpu::UNIFORM_SCENE_WORDS;
    result[gpu::ID_UNIFORM_READS] = device.policy().compiles_for_cpu && fits ? 1 : 0;
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

TracePipelines::TracePipelines(vulkan::Device &device, KernelCode code) :
    device_(device),
    code_(std::move(code)),
    kernel_key_(device.kernel_key(digest_of(code_))) {}

const vulkan::ComputePipeline &TracePipelines::build(std::vector<std::uint32_t> constants) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    vulkan::ComputePipeline pipeline =
        specialised_pipeline(device_, code_.pathtrace, trace_bindings(), sizeof(gpu::FrameConstants), constants);
    device_.log().info([&] {
        const auto milliseconds = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start).count();
        const bool own = constants[gpu::ID_SCENE_SOURCE] == gpu::SCENE_IN_CONSTANTS;
        return std::string("built a kernel for ") + (own ? "this scene alone" : "all scenes of this kind") + " in " +
               std::to_string(milliseconds) + " ms";
    });
    kept_.push_front({std::move(constants), std::move(pipeline)});
    if (kept_.size() > most_kept)
        kept_.pop_back();
    return kept_.front().pipeline;
}

const vulkan::ComputePipeline *TracePipelines::find(const std::vector<std::uint32_t> &constants) {
    const auto found = std::ranges::find(kept_, constants, &Specialised::constants);
    if (found == kept_.end())
        return nullptr;
    kept_.splice(kept_.begin(), kept_, found);
    return &found->pipeline;
}

void TracePipelines::note_own(const std::vector<std::uint32_t> &constants, double seconds) {
    if (!own_)
        return;
    if (own_->constants == constants) {
        own_->used_seconds += std::max(seconds - own_->last_seconds, 0.0);
        own_->last_seconds = seconds;
    } else {
        clock_.left_after(own_->used_seconds);
        own_.reset();
    }
}

const vulkan::ComputePipeline &TracePipelines::trace(const Features &features, std::span<const glm::vec4> words,
                                                     double seconds) {
    std::vector<std::uint32_t> constants = constants_of_features(device_, features);
    if (device_.policy().scene_in_constants && features.scene_in_uniform() &&
        words.size() <= gpu::CONSTANT_SCENE_WORDS) {
        std::vector<std::uint32_t> own = with_scene(constants, words);
        note_own(own, seconds);
        if (const vulkan::ComputePipeline *const kept = find(own))
            return *kept;
        if (kept_.empty() || own_kernels_ == OwnKernels::at_once ||
            (own_kernels_ == OwnKernels::when_they_pay && clock_.is_time(seconds))) {
            OwnKernel next{own, seconds, 0.0};
            const vulkan::ComputePipeline &built = build(std::move(own));
            own_ = std::move(next);
            return built;
        }
    }
    if (const vulkan::ComputePipeline *const kept = find(constants))
        return *kept;
    return build(std::move(constants));
}

const vulkan::ComputePipeline &TracePipelines::fold() {
    if (!fold_)
        fold_.emplace(device_, code_.fold, trace_bindings(), sizeof(gpu::FrameConstants),
                      std::span<const std::uint32_t>{});
    return *fold_;
}

} // namespace pt
