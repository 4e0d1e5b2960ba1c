#include "tests/render/reference_image.h"
#include "tests/support/context_fixture.h"
#include "tests/support/coursework_scene.h"
#include "tests/support/render_image.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace {

constexpr uint32_t width = 256;
constexpr uint32_t height = 128;
// Each batch has another seed, because quasi-random samples of one seed depend on each other.
constexpr uint32_t batch_count = 16;
constexpr uint32_t batch_samples = 16;
constexpr uint32_t block_size = 8;

struct Case {
    const char *reference;
    bool diffuse;
    uint32_t max_path_length;
    double reference_rmse;
    uint32_t sampler;
};

using Image = std::vector<float>;

double block_mean(const Image &image, uint32_t block, uint32_t channel) {
    const uint32_t left = block % (width / block_size) * block_size;
    const uint32_t top = block / (width / block_size) * block_size;
    double sum = 0.0;
    for (uint32_t y = top; y < top + block_size; ++y)
        for (uint32_t x = left; x < left + block_size; ++x)
            sum += image[(y * width + x) * 3 + channel];
    return sum / (block_size * block_size);
}

double noise_of_mean(const std::vector<Image> &batches) {
    double sum = 0.0;
    std::vector<double> values(batches.size());
    for (std::size_t i = 0; i < batches[0].size(); ++i) {
        for (std::size_t b = 0; b < batches.size(); ++b)
            values[b] = batches[b][i];
        sum += statistics::moments(values).variance / static_cast<double>(batches.size());
    }
    return sum / static_cast<double>(batches[0].size());
}

struct Agreement {
    double mean_square_t;
    double largest_t;
};

// Computes Student's t for each block and channel. The reference's total noise is known. The test assumes that this
// noise is distributed over blocks like the batches' noise.
Agreement agreement(const std::vector<Image> &batches, const Image &reference, double reference_rmse) {
    const double reference_share = reference_rmse * reference_rmse / noise_of_mean(batches);
    constexpr uint32_t blocks = (width / block_size) * (height / block_size);
    Agreement result{0.0, 0.0};
    uint32_t noisy = 0;
    std::vector<double> values(batches.size());
    for (uint32_t i = 0; i < 3 * blocks; ++i) {
        for (std::size_t b = 0; b < batches.size(); ++b)
            values[b] = block_mean(batches[b], i / 3, i % 3);
        const auto [mean, variance] = statistics::moments(values);
        const double expected = block_mean(reference, i / 3, i % 3);
        if (variance == 0.0) { // Only emission is visible. It is exact, unlike the reference's sums.
            if (std::abs(mean - expected) > 1e-5 * expected)
                result.largest_t = std::numeric_limits<double>::infinity();
            continue;
        }
        const double of_mean = variance / static_cast<double>(batches.size()) * (1.0 + reference_share);
        const double t = (mean - expected) / std::sqrt(of_mean);
        result.mean_square_t += t * t;
        result.largest_t = std::max(result.largest_t, std::abs(t));
        ++noisy;
    }
    result.mean_square_t /= noisy;
    return result;
}

// For k = 15 degrees of freedom, t^2 has the mean k / (k - 2) = 1.154 and the standard deviation 1.84. The mean over
// 512 blocks has the standard deviation 0.081 if their channels are alike. The tolerance 0.5 allows for sums that are
// not quite normal, and still detects a bias of one standard error in each block.
constexpr double expected_mean_square_t = 15.0 / 13.0;
constexpr double mean_square_t_bound = expected_mean_square_t + 0.5;
// For 15 degrees of freedom, P(|t| > 8.5) is 4e-7. Over 512 blocks and three channels this is 6e-4.
constexpr double largest_t_bound = 8.5;

class RenderTest : public ContextFixture {
protected:
    std::vector<Image> render_batches(const Case &test_case) {
        CourseworkScene coursework;
        if (test_case.diffuse)
            coursework.make_diffuse();
        std::vector<Image> batches;
        for (uint32_t b = 0; b < batch_count; ++b) {
            pt_render render = render_of(width, height, test_case.max_path_length);
            render.seed = b + 1;
            render.sampler = test_case.sampler;
            batches.push_back(
                render_image(context(), coursework.scene(), CourseworkScene::camera(), render, batch_samples));
        }
        return batches;
    }
};

TEST_F(RenderTest, AgreesWithReference) {
    for (const Case &each : {Case{"coursework_L1", false, 1, 0.05003, PT_SAMPLER_RANDOM},
                             {"coursework_L2", false, 2, 0.00537, PT_SAMPLER_BEST},
                             {"coursework_L6", false, 6, 0.0243, PT_SAMPLER_BEST},
                             {"coursework-diffuse_L2", true, 2, 0.00384, PT_SAMPLER_BEST}}) {
        SCOPED_TRACE(each.reference);
        const ReferenceImage reference = read_reference(each.reference);
        ASSERT_EQ(reference.width, width);
        ASSERT_EQ(reference.height, height);
        std::vector<Image> batches = render_batches(each);
        const Agreement found = agreement(batches, reference.radiance, each.reference_rmse);
        EXPECT_LT(found.mean_square_t, mean_square_t_bound);
        EXPECT_LT(found.largest_t, largest_t_bound);
        EXPECT_EQ(stats().rejected_samples, 0U);
        if (each.max_path_length == 1)
            continue;

        // Negative control: 3% too bright.
        for (Image &batch : batches)
            for (float &value : batch)
                value *= 1.03F;
        EXPECT_GT(agreement(batches, reference.radiance, each.reference_rmse).mean_square_t, mean_square_t_bound);
    }
}

} // namespace
