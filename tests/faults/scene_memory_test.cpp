#include "tests/faults/allocations.h"
#include "tests/faults/vulkan_calls.h"
#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <map>
#include <random>
#include <string>
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
    std::vector<std::uint32_t> materials_of_spheres = std::vector<std::uint32_t>(sphere_count, 0);
    float radius = 0.001F;
    pt_sphere_array array{};

    ManySpheres() {
        std::mt19937 engine(41);
        for (std::uint32_t i = 0; i < 3 * sphere_count; ++i)
            centers.push_back(static_cast<float>(engine() >> 8) * 0x1p-24F);
        array = array_of(sphere_count, {centers.data(), 12, PT_TYPE_FLOAT32}, {&radius, 0, PT_TYPE_FLOAT32});
        array.material = {materials_of_spheres.data(), 4, PT_TYPE_UINT32};
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

Context default_context() {
    pt_context *context = nullptr;
    EXPECT_EQ(pt_create(nullptr, &context), PT_OK) << pt_last_error(nullptr);
    return Context(context);
}

// A sphere takes at most 48 bytes of words, 4 of indices and 12 meanwhile. Motion and color take 20 more.
TEST(SceneMemoryTest, Is64BytesASphere) {
    ManySpheres spheres;
    const auto expect_at_most = [&](double more) {
        const Context context = default_context();
        const Taken anew = taken_by(context.get(), spheres.scene());
        EXPECT_LE(anew.meanwhile, 64 + more);
        EXPECT_LE(anew.after, 48 + 4 + more);
        const Taken kept = taken_by(context.get(), spheres.scene());
        EXPECT_LE(kept.meanwhile, 64 + more);
        EXPECT_LT(kept.after, 0.01);
    };
    expect_at_most(0);
    spheres.materials_of_spheres[sphere_count / 2] = 1; // a lamp
    expect_at_most(0);
    spheres.array.motion = {spheres.motions.data(), 12, PT_TYPE_FLOAT32};
    spheres.array.color = {spheres.colors.data(), 3, PT_TYPE_SRGB8};
    expect_at_most(20);
}

// Leak checks miss memory that is freed with the context.
TEST(SceneMemoryTest, IsConstantOverManyScenes) {
    constexpr int warm = 50;
    const Context context = default_context();
    CourseworkScene coursework;
    long allocations = 0;
    std::uint64_t device_bytes = 0;
    std::map<std::string, long> objects;
    for (int round = 0; round < 200; ++round) {
        coursework.spheres[2].center[1] = -2 + 1e-3 * (round % 10);
        {
            const InLibrary in_library;
            set_picture(context.get(), coursework.scene(), CourseworkScene::camera(), render_of(16, 8, 2));
            accumulate_on(context.get(), 1);
            values_of(context.get(), 16 * 8);
        }
        if (round < warm) {
            allocations = live_allocations();
            device_bytes = stats_of(context.get()).device_bytes;
            objects = live_objects();
        }
    }
    EXPECT_EQ(live_allocations(), allocations);
    EXPECT_EQ(stats_of(context.get()).device_bytes, device_bytes);
    EXPECT_EQ(live_objects(), objects);
}

} // namespace
