// Tests changes of a scene that keep the image apart from its noise.
#include "tests/invariance/invariance_scene.h"
#include "tests/support/batch_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

namespace {

constexpr uint32_t symmetry_width = 64;
constexpr uint32_t symmetry_height = 32;
constexpr uint32_t block_size = 4;
constexpr std::size_t blocks = (symmetry_width / block_size) * (symmetry_height / block_size);
constexpr uint32_t batch_count = 16;
constexpr uint32_t batch_samples = 16;

std::vector<std::size_t> pixels_of_block(std::size_t block) {
    std::vector<std::size_t> pixels;
    const std::size_t left = block % (symmetry_width / block_size) * block_size;
    const std::size_t top = block / (symmetry_width / block_size) * block_size;
    for (std::size_t y = top; y < top + block_size; ++y)
        for (std::size_t x = left; x < left + block_size; ++x)
            pixels.push_back(y * symmetry_width + x);
    return pixels;
}

struct Agreement {
    double mean_square_t;
    double largest_t;
};

// Student's t for two means with equal noise. It has 2 * (16 - 1) degrees of freedom.
Agreement agreement(const Batches &a, const Batches &b) {
    Agreement result{0.0, 0.0};
    for (std::size_t block = 0; block < blocks; ++block) {
        const std::vector<std::size_t> pixels = pixels_of_block(block);
        const Estimate first = estimate_over(a, pixels);
        const Estimate second = estimate_over(b, pixels);
        const double rounding = 1e-6 * first.mean;
        const double t = (first.mean - second.mean) / std::hypot(first.standard_error, second.standard_error, rounding);
        result.mean_square_t += t * t / static_cast<double>(blocks);
        result.largest_t = std::max(result.largest_t, std::abs(t));
    }
    return result;
}

// For k = 30 degrees of freedom, t^2 has the mean k / (k - 2) = 1.071 and the deviation 1.6. The deviation of the mean
// over 128 blocks is 0.14.
constexpr double expected_mean_square_t = 30.0 / 28.0;
constexpr double mean_square_t_bound = expected_mean_square_t + 6.0 * 0.14;
const double largest_t_bound = student_bound(1e-6 / (6.0 * blocks), 2 * batch_count - 1);

class Symmetry : public BatchFixture, public testing::WithParamInterface<InvarianceOf> {
protected:
    static InvarianceScene scene() { return InvarianceScene::of(GetParam()); }

    Batches batches_of(const InvarianceScene &scene, uint64_t first_seed) {
        set_up(scene.scene(), scene.camera);
        pt_render render = render_of(symmetry_width, symmetry_height, 3);
        render.seed = first_seed;
        return render_batches(render, batch_count, batch_samples);
    }

    const Batches &original() {
        static std::map<InvarianceOf, Batches> rendered;
        Batches &batches = rendered[GetParam()];
        if (batches.empty())
            batches = batches_of(scene(), 0);
        return batches;
    }

    template <typename Restore>
    void expect_same_image(InvarianceScene changed, const Restore &restore) {
        const Agreement same = agreement(original(), restore(batches_of(changed, 1000)));
        changed.multiply_diffuse(0.97F);
        const Agreement darker = agreement(original(), restore(batches_of(changed, 2000)));
        std::printf("mean t^2 %.3f (expected %.3f), largest |t| %.2f; 3%% darker %.1f, %.1f\n", same.mean_square_t,
                    expected_mean_square_t, same.largest_t, darker.mean_square_t, darker.largest_t);
        EXPECT_LT(same.mean_square_t, mean_square_t_bound);
        EXPECT_LT(same.largest_t, largest_t_bound);
        EXPECT_GT(darker.mean_square_t, mean_square_t_bound);
        EXPECT_GT(darker.largest_t, largest_t_bound);
    }
};

Batches unchanged(Batches batches) {
    return batches;
}

Batches mirrored(Batches batches) {
    for (std::vector<double> &image : batches)
        for (auto row = image.begin(); row != image.end(); row += symmetry_width)
            std::reverse(row, row + symmetry_width);
    return batches;
}

TEST_P(Symmetry, OrderOfSurfaces) {
    InvarianceScene reordered = scene();
    reordered.reverse_objects();
    expect_same_image(reordered, unchanged);
}

TEST_P(Symmetry, Mirror) {
    InvarianceScene other = scene();
    other.turn({{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    expect_same_image(other, mirrored);
    EXPECT_GT(agreement(original(), mirrored(original())).mean_square_t, mean_square_t_bound)
        << "the scene is symmetric";
}

TEST_P(Symmetry, Rotation) {
    InvarianceScene turned = scene();
    turned.turn({{2.0 / 3, -2.0 / 3, 1.0 / 3}, {1.0 / 3, 2.0 / 3, 2.0 / 3}, {-2.0 / 3, -1.0 / 3, 2.0 / 3}});
    expect_same_image(turned, unchanged);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Symmetry, testing::Values(InvarianceOf::Coursework, InvarianceOf::ManyLamps),
                         [](const auto &param) { return name_of(param.param); });

} // namespace
