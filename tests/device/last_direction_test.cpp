// One last direction for all branches of a sample (shaders/last_direction.glsl) brings the light that a direction for
// each of them does. Run alone with --gtest_filter=LastDirection*.
#include "reservoir.spv.h"
#include "tests/device/kernel_render.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>
#include <pt/pt.h>

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace {

constexpr std::uint32_t whole_length = 5;
constexpr std::uint64_t picture_seeds = 80;

// A room of which some surfaces are polished, so that directions find much light which lamp sampling does not, and
// some are matt, so that branches differ in worth. What the camera sees most of is both, so that of the branches, over
// which the choice between the two is stratified, the first are unlike the last.
pt::Scene polished_room() {
    pt::Scene scene;
    scene.materials = {{glm::vec3(0.05F), glm::vec3(0.9F), glm::vec3(0), 300},
                       {glm::vec3(0.8F, 0.6F, 0.4F), glm::vec3(0), glm::vec3(0), 0},
                       {glm::vec3(0), glm::vec3(0), glm::vec3(6, 5, 4), 0},
                       {glm::vec3(0.4F), glm::vec3(0.5F), glm::vec3(0), 200}};
    scene.spheres = {{{0.5, 1, -4}, 1.2, {0, 0, 0}, 2}, {{-1.5, -1, -5}, 0.8, {0, 0, 0}, 0}};
    scene.planes = {{{0, 1, 0}, 2, 1},  {{0, -1, 0}, 3, 0}, {{0, 0, 1}, 7, 3},
                    {{0, 0, -1}, 1, 1}, {{1, 0, 0}, 3, 0},  {{-1, 0, 0}, 3, 0}};
    return scene;
}

// Takes pictures with one kernel.
class Pictures {
public:
    Pictures(bool one_last_direction, std::uint32_t length) :
        one_last_direction_(one_last_direction),
        length_(length),
        probe_(probe()) {}

    // Red of each pixel.
    std::vector<double> with_seed(std::uint64_t seed) {
        const KernelRender render(scene_of(seed));
        const std::vector<float> radiance = render.radiance(render.film_by(probe_));
        std::vector<double> red;
        for (std::size_t i = 0; i < radiance.size(); i += 3)
            red.push_back(double{radiance[i]});
        return red;
    }

private:
    pt::GpuScene scene_of(std::uint64_t seed) const {
        const pt::Camera camera{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0, 1};
        pt::RenderSettings settings = KernelRender::settings(length_);
        settings.seed = seed;
        pt::GpuScene scene = pt::gpu_scene(prepared_, camera, settings);
        EXPECT_EQ(scene.features.one_last_direction, length_ == whole_length);
        scene.features.one_last_direction = one_last_direction_;
        return scene;
    }

    Probe probe() const {
        const KernelRender render(scene_of(0));
        return render.probe_of_kernel(render.constants(), pt::gpu::SCENE_IN_UNIFORM, render.words());
    }

    bool one_last_direction_;
    std::uint32_t length_;
    pt::PreparedScene prepared_{polished_room()};
    Probe probe_;
};

// What the last direction brings is a part of what only paths of that length do. Given the table of points pixels are
// independent, and all else is common to the two pictures.
TEST(LastDirection, OfOneBranchBringsTheLightOfAll) {
    Pictures shared(true, whole_length);
    Pictures own(false, whole_length);
    Pictures shorter(false, whole_length - 1);
    std::vector<double> differences;
    double longest = 0.0;
    for (std::uint64_t seed = 0; seed < picture_seeds; ++seed) {
        const std::vector<double> by_one = shared.with_seed(seed);
        const std::vector<double> by_all = own.with_seed(seed);
        const std::vector<double> without = shorter.with_seed(seed);
        for (std::size_t i = 0; i < by_one.size(); ++i) {
            differences.push_back(by_one[i] - by_all[i]);
            longest += by_all[i] - without[i];
        }
    }
    const auto count = static_cast<double>(differences.size());
    const statistics::Moments moments = statistics::moments(differences);
    const double bound = statistics::normal_quantile(0.5e-6) * std::sqrt(moments.variance / count); // one in a million
    EXPECT_NE(moments.variance, 0.0);
    EXPECT_LT(std::abs(moments.mean), bound);
    EXPECT_LT(bound, 0.1 * longest / count) << "or so much of it could be missing";
}

// What the probe writes for each number.
struct Kept {
    std::uint32_t branch;
    float worth;
    float total_worth;
    float number;
};

// Numbers spread evenly keep each branch as often as its share says, to one at each end of the range of numbers that
// choose it, of which there are up to six; and the numbers that are left of these are spread evenly again.
TEST(LastDirection, IsOfEachBranchAsOftenAsItIsWorth) {
    constexpr std::uint32_t numbers = 1U << 16;
    struct {
        glm::vec4 worths;
        std::uint32_t count;
    } push{};
    push.count = numbers;
    Probe probe(reservoir_spirv(), sizeof push);
    for (const glm::vec4 &worths : {glm::vec4(1, 1, 1, 1), glm::vec4(1, 2, 3, 4), glm::vec4(8, 1, 0, 1),
                                    glm::vec4(0, 0, 5, 0), glm::vec4(0, 1e-20F, 3e-20F, 0)}) {
        push.worths = worths;
        const double total = double{worths.x} + double{worths.y} + double{worths.z} + double{worths.w};
        const std::vector<Kept> kept = probe.run<Kept>({}, numbers, push, numbers);
        std::array<double, 4> counts{};
        std::array<double, 4> sums{};
        for (const Kept &one : kept) {
            ASSERT_LT(one.branch, 4U);
            EXPECT_EQ(one.worth, worths[static_cast<int>(one.branch)]);
            EXPECT_FLOAT_EQ(one.total_worth, static_cast<float>(total));
            EXPECT_LT(one.number, 1.0F);
            ++counts[one.branch];
            sums[one.branch] += double{one.number};
        }
        for (std::size_t branch = 0; branch < 4; ++branch) {
            EXPECT_NEAR(counts[branch], numbers * double{worths[static_cast<int>(branch)]} / total, 6.0);
            if (counts[branch] > 0) {
                EXPECT_NEAR(sums[branch] / counts[branch], 0.5, 6.0 / counts[branch]);
            }
        }
    }
}

} // namespace
