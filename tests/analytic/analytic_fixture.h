#pragma once

#include "tests/support/batch_fixture.h"
#include "tests/support/scene_of.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace analytic {

struct Image {
    std::uint32_t width;
    std::uint32_t height;
    std::vector<float> radiance;

    double red(std::uint32_t x, std::uint32_t y) const { return radiance[3 * (std::size_t{y} * width + x)]; }
};

// PT_TEST_TREE puts all spheres into trees, and divides sample counts by samples_for_one(), a power of two.
bool always_tree();
inline std::uint32_t samples_for_one() {
    return always_tree() ? 8 : 1;
}

class AnalyticFixture : public BatchFixture {
protected:
    Context create_fixtures_context() override;

    void TearDown() override;

    Image image_of(const pt_scene &scene, const pt_camera &camera, const pt_render &render, std::uint32_t sample_count);
};

} // namespace analytic
