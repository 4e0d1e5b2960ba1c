#include "lib/kernel/trace_pipelines.h"

#include "tests/vulkan/device_fixture.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace {

using pt::vulkan::ComputePipeline;

pt::Features features_of_a_sphere(std::uint32_t sampler = PT_SAMPLER_RANDOM) {
    pt::Features features{};
    features[pt::gpu::ID_SPHERE_COUNT] = 1;
    features[pt::gpu::ID_MAX_PATH_LENGTH] = 1;
    features[pt::gpu::ID_ESTIMATOR] = PT_ESTIMATOR_MIS;
    features[pt::gpu::ID_SAMPLER] = sampler;
    features[pt::gpu::ID_SCENE_SOURCE] = pt::gpu::SCENE_IN_UNIFORM;
    return features;
}

using Words = std::vector<glm::vec4>;

const Words ball = {{0, 0, -4, 1}, {1, 1, 1, 1}, {0, 0, 0, 0}};
const Words other_ball = {{0, 0, -5, 1}, {1, 1, 1, 1}, {0, 0, 0, 0}};
const Words third_ball = {{0, 0, -6, 1}, {1, 1, 1, 1}, {0, 0, 0, 0}};

class TracePipelinesTest : public VulkanFixture {
protected:
    void use(bool scene_in_constants) {
        pipelines_.emplace(device_with({.patience = std::chrono::hours{1},
                                        .share_memory = true,
                                        .scene_in_constants = scene_in_constants,
                                        .invocations = 0,
                                        .queue_depth = 1}));
    }

    const ComputePipeline *trace(const Words &words, double seconds, std::uint32_t sampler = PT_SAMPLER_RANDOM) {
        return &pipelines_->trace(features_of_a_sphere(sampler), words, seconds);
    }

    void TearDown() override {
        pipelines_.reset();
        VulkanFixture::TearDown();
    }

    std::optional<pt::TracePipelines> pipelines_;
};

TEST_F(TracePipelinesTest, TheFirstSceneGetsAKernelOfItsOwnAndOthersWhenItPays) {
    use(true);
    const ComputePipeline *own = trace(ball, 0.0);
    EXPECT_EQ(trace(ball, 1.5), own);

    const ComputePipeline *any = trace(other_ball, 0.0);
    EXPECT_NE(any, own);
    EXPECT_EQ(trace(other_ball, 0.9), any);
    EXPECT_EQ(trace(ball, 0.0), own) << "that kernel is still there";
    const ComputePipeline *other_own = trace(other_ball, 1.1);
    EXPECT_NE(other_own, any) << "after a second, as the first has paid";
    EXPECT_NE(other_own, own);
    EXPECT_EQ(trace(other_ball, 0.0), other_own);
    EXPECT_EQ(trace(ball, 0.0), own) << "and so is this one";
    EXPECT_EQ(trace(third_ball, 0.0), any);

    const ComputePipeline *any_of_other_kind = trace(ball, 0.0, PT_SAMPLER_SOBOL);
    EXPECT_EQ(trace(other_ball, 0.0, PT_SAMPLER_SOBOL), any_of_other_kind)
        << "only the first scene of all does not wait";
}

TEST_F(TracePipelinesTest, WhoPollsKeepsTheKernelThatThereIsAndWhoPreparesGetsTheFastest) {
    use(true);
    const ComputePipeline *own = trace(ball, 0.0);
    const ComputePipeline *any = trace(other_ball, 0.0);
    pipelines_->build_own(pt::TracePipelines::OwnKernels::never);
    EXPECT_EQ(trace(other_ball, 100.0), any);
    pipelines_->build_own(pt::TracePipelines::OwnKernels::at_once);
    const ComputePipeline *other_own = trace(other_ball, 0.0);
    EXPECT_NE(other_own, any);
    EXPECT_NE(other_own, own);
    pipelines_->build_own(pt::TracePipelines::OwnKernels::when_they_pay);
    EXPECT_EQ(trace(third_ball, 0.0), any);
}

// The least recently used kernel is dropped. It is not compared, because a new one may have its address.
TEST_F(TracePipelinesTest, AHandfulIsKept) {
    use(false);
    const auto of_lamps = [&](std::uint32_t lamp_count) {
        pt::Features features = features_of_a_sphere();
        features[pt::gpu::ID_LAMP_COUNT] = lamp_count;
        return &pipelines_->trace(features, ball, 0.0);
    };
    std::vector<const ComputePipeline *> kernels;
    for (std::uint32_t lamps = 0; lamps < pt::TracePipelines::most_kept; ++lamps)
        kernels.push_back(of_lamps(lamps));
    for (std::uint32_t lamps = 0; lamps < kernels.size(); ++lamps)
        EXPECT_EQ(of_lamps(lamps), kernels[lamps]) << lamps;
    of_lamps(0);
    of_lamps(100); // instead of 1
    EXPECT_EQ(of_lamps(0), kernels[0]);
    for (std::uint32_t lamps = 2; lamps < kernels.size(); ++lamps)
        EXPECT_EQ(of_lamps(lamps), kernels[lamps]) << lamps;
}

TEST_F(TracePipelinesTest, ASceneOfManyWordsReadsABuffer) {
    use(true);
    pt::Features features = features_of_a_sphere();
    features[pt::gpu::ID_SPHERE_COUNT] = 22;
    const ComputePipeline *any = &pipelines_->trace(features, Words(66), 0.0);
    EXPECT_EQ(&pipelines_->trace(features, Words(66, glm::vec4(1)), 0.0), any);
    EXPECT_EQ(&pipelines_->trace(features, Words(66), 100.0), any);
    features[pt::gpu::ID_SPHERE_COUNT] = 21;
    pipelines_->build_own(pt::TracePipelines::OwnKernels::at_once);
    const ComputePipeline *own = &pipelines_->trace(features, Words(pt::gpu::CONSTANT_SCENE_WORDS - 1), 0.0);
    EXPECT_NE(&pipelines_->trace(features, Words(pt::gpu::CONSTANT_SCENE_WORDS - 1, glm::vec4(1)), 0.0), own);
}

TEST_F(TracePipelinesTest, WhereConstantsAreNoFasterAllScenesReadABuffer) {
    use(false);
    const ComputePipeline *any = trace(ball, 0.0);
    EXPECT_EQ(trace(other_ball, 0.0), any);
    EXPECT_EQ(trace(other_ball, 100.0), any);
    pipelines_->build_own(pt::TracePipelines::OwnKernels::at_once);
    EXPECT_EQ(trace(other_ball, 0.0), any);
}

} // namespace
