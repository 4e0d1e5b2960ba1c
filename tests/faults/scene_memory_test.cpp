#include "tests/faults/allocations.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

namespace {

using namespace faults;

constexpr std::uint32_t sphere_count = 200'000;

// pt_scene points into this object.
struct ManySpheres {
    std::vector<pt_material> materials = {{{0.5F, 0.5F, 0.5F}, {0, 0, 0}, {0, 0, 0}, 0, 0},
                                          {{0, 0, 0}, {0, 0, 0}, {1, 1, 1}, 0, 0}};
    std::vector<float> centers;
    std::vector<float> motions = std::vector<float>(3 * sphere_count, 1e-4F);
    std::vector<unsigned char> colors = std::vector<unsigned char>(3 * sphere_count, 77);
    float radius = 0.001F;
    std::uint32_t material = 0;
    pt_sphere_array array{};

    ManySpheres() {
        std::mt19937 engine(41);
        for (std::uint32_t i = 0; i < 3 * sphere_count; ++i)
            centers.push_back(static_cast<float>(engine() >> 8) * 0x1p-24F);
        array.struct_size = sizeof array;
        array.count = sphere_count;
        array.center = {centers.data(), 12, PT_TYPE_FLOAT32};
        array.radius = {&radius, 0, PT_TYPE_FLOAT32};
        array.material = {&material, 0, PT_TYPE_UINT32};
    }

    pt_scene scene() { return scene_of(materials, {}, {}, {&array, 1}); }
};

struct Taken {
    double meanwhile;
    double after;
};

Taken taken_by(pt_context *context, const pt_scene &scene) {
    const InLibrary in_library;
    const long before = begin_most_bytes();
    EXPECT_EQ(pt_set_scene(context, &scene), PT_OK) << pt_last_error(context);
    const long most = most_live_bytes();
    const long after = begin_most_bytes();
    const Taken taken{static_cast<double>(most - before) / sphere_count,
                      static_cast<double>(after - before) / sphere_count};
    std::printf("%.1f bytes a sphere meanwhile, %.1f more after\n", taken.meanwhile, taken.after);
    return taken;
}

class SceneMemoryTest : public testing::Test {
protected:
    void SetUp() override { ASSERT_EQ(pt_create(nullptr, &context_), PT_OK) << pt_last_error(nullptr); }
    void TearDown() override { pt_destroy(context_); }

    pt_context *context() const { return context_; }

    void expect_at_most(ManySpheres &spheres, double meanwhile, double after) {
        const Taken anew = taken_by(context(), spheres.scene());
        EXPECT_LE(anew.meanwhile, meanwhile);
        EXPECT_LE(anew.after, after);
        const Taken kept = taken_by(context(), spheres.scene());
        EXPECT_LE(kept.meanwhile, meanwhile);
        EXPECT_LT(kept.after, 0.01);
    }

private:
    pt_context *context_ = nullptr;
};

// A sphere takes at most 48 bytes of device words, plus indices.
TEST_F(SceneMemoryTest, Is64BytesASphere) {
    ManySpheres spheres;
    expect_at_most(spheres, 64, 48 + 4);
}

TEST_F(SceneMemoryTest, IsNoMoreWithALampAmongThem) {
    ManySpheres spheres;
    std::vector<std::uint32_t> materials(sphere_count, 0);
    materials[sphere_count / 2] = 1;
    spheres.array.material = {materials.data(), 4, PT_TYPE_UINT32};
    expect_at_most(spheres, 64, 48 + 4);
}

TEST_F(SceneMemoryTest, IsMoreWithMotionAndColors) {
    ManySpheres spheres;
    spheres.array.motion = {spheres.motions.data(), 12, PT_TYPE_FLOAT32};
    spheres.array.color = {spheres.colors.data(), 3, PT_TYPE_SRGB8};
    expect_at_most(spheres, 64 + 20, 48 + 4 + 20);
}

} // namespace
