// Which kernel a scene gets: one of its own, with its numbers as constants, or one that reads any scene of the same
// kind.
#include "lib/kernel/trace_pipelines.h"

#include "tests/device/vulkan_fixture.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <chrono>
#include <cstdint>
#include <vector>

namespace {

using pt::vulkan::ComputePipeline;

// One sphere, seen directly: the smallest kernel there is.
pt::Features features_of_a_sphere(std::uint32_t sampler = PT_SAMPLER_RANDOM) {
    pt::Features features{};
    features.sphere_count = 1;
    features.max_path_length = 1;
    features.estimator = PT_ESTIMATOR_MIS;
    features.sampler = sampler;
    features.scene_in_uniform = true;
    return features;
}

using Words = std::vector<glm::vec4>;

const Words ball = {{0, 0, -4, 1}, {1, 1, 1, 1}, {0, 0, 0, 0}};
const Words other_ball = {{0, 0, -5, 1}, {1, 1, 1, 1}, {0, 0, 0, 0}};

class TracePipelinesTest : public VulkanFixture {
protected:
    pt::TracePipelines pipelines_with(bool scene_in_constants) {
        return pt::TracePipelines(device_with({.patience = std::chrono::hours{1},
                                               .share_memory = true,
                                               .scene_in_constants = scene_in_constants,
                                               .invocations = 0,
                                               .queue_depth = 1}));
    }
};

// The two kinds of kernel are told apart by where they are kept.
TEST_F(TracePipelinesTest, ASceneGetsAKernelOfItsOwnAtOnceOrOnceItPays) {
    pt::TracePipelines pipelines = pipelines_with(true);
    const pt::Features features = features_of_a_sphere();
    const ComputePipeline *own = &pipelines.trace(features, 1, ball, 0.0);
    EXPECT_EQ(&pipelines.trace(features, 1, ball, 0.5), own);

    const ComputePipeline *any = &pipelines.trace(features, 1, other_ball, 0.0);
    EXPECT_NE(any, own) << "it took the place of a scene with the same features";
    EXPECT_EQ(&pipelines.trace(features, 1, other_ball, 0.9), any);
    EXPECT_EQ(&pipelines.trace(features, 1, ball, 0.0), own) << "that kernel is still there";
    EXPECT_EQ(&pipelines.trace(features, 1, other_ball, 1.1), own) << "after a second";
    EXPECT_EQ(&pipelines.trace(features, 1, other_ball, 0.0), own);
    EXPECT_EQ(&pipelines.trace(features, 1, ball, 0.0), any) << "its kernel has made place";

    const pt::Features other_features = features_of_a_sphere(PT_SAMPLER_SOBOL);
    EXPECT_EQ(&pipelines.trace(other_features, 1, ball, 0.0), own) << "the first scene with these features";
    EXPECT_EQ(&pipelines.trace(other_features, 1, other_ball, 0.0), any);
}

TEST_F(TracePipelinesTest, ASceneOfManyWordsReadsABuffer) {
    pt::TracePipelines pipelines = pipelines_with(true);
    pt::Features features = features_of_a_sphere();
    const ComputePipeline *own = &pipelines.trace(features, 1, ball, 0.0);
    features.sphere_count = 21; // 63 words
    EXPECT_EQ(&pipelines.trace(features, 1, Words(pt::gpu::CONSTANT_SCENE_WORDS - 1), 0.0), own);
    features.sphere_count = 22; // 66 words
    EXPECT_NE(&pipelines.trace(features, 1, Words(66), 0.0), own);
    EXPECT_NE(&pipelines.trace(features, 1, Words(66), 100.0), own);
}

TEST_F(TracePipelinesTest, WhereConstantsAreNoFasterAllScenesReadABuffer) {
    pt::TracePipelines pipelines = pipelines_with(false);
    const pt::Features features = features_of_a_sphere();
    const ComputePipeline *any = &pipelines.trace(features, 1, ball, 0.0);
    EXPECT_EQ(&pipelines.trace(features, 1, other_ball, 0.0), any);
    EXPECT_EQ(&pipelines.trace(features, 1, other_ball, 100.0), any);
    EXPECT_EQ(&pipelines.trace(features_of_a_sphere(PT_SAMPLER_SOBOL), 1, ball, 0.0), any);
}

} // namespace
