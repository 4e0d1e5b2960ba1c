#include "tests/geometry/particles.h"
#include "tests/geometry/refusals.h"
#include "tests/support/expected_error.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <string>

namespace sphere_arrays {

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

const auto outcome = [](const Particles &particles) {
    return outcome_of(PT_ERROR_INVALID_SCENE, [&] { particles.validated(); });
};

#define SPOILT(change) [](Particles &p) { p.spoil = [](pt_sphere_array &a) { change; }; }

TEST(SphereArrays, BrokenRulesOfColumnsAreNamed) {
    const std::string missing = ".data = NULL: must not be NULL, as count is 4";
    const std::string lost = ".data = NULL: must not be NULL where type or stride_bytes is set";
    const std::string real = "must be PT_TYPE_FLOAT32 (1) or PT_TYPE_FLOAT64 (2)";
    expect_refusals<Particles>(
        {}, outcome,
        {{SPOILT(a.center = {}; a.radius.data = nullptr; a.motion.data = nullptr;
                 a.material = (pt_column{nullptr, 0, PT_TYPE_UINT32}); a.color = (pt_column{nullptr, 12, 0})),
          "sphere_arrays[0].center" + missing + "\nsphere_arrays[0].radius" + missing + "\nsphere_arrays[0].motion" +
              lost + "\nsphere_arrays[0].material" + lost + "\nsphere_arrays[0].color" + lost},
         {SPOILT(a.count = 0; a.center.data = nullptr; a.radius = (pt_column{nullptr, 1, 77})), "accepted"},
         {SPOILT(a.center.type = PT_TYPE_UINT32; a.radius.type = PT_TYPE_SRGB8; a.motion.type = 0;
                 a.material.type = PT_TYPE_FLOAT32; a.color.type = 4294967295U),
          "sphere_arrays[0].center.type = 3: " + real + "\nsphere_arrays[0].radius.type = 4: " + real +
              "\nsphere_arrays[0].motion.type = 0: " + real +
              "\nsphere_arrays[0].material.type = 1: must be PT_TYPE_UINT32 (3)\n"
              "sphere_arrays[0].color.type = 4294967295: must be PT_TYPE_FLOAT32 (1), PT_TYPE_FLOAT64 (2) or "
              "PT_TYPE_SRGB8 (4)"},
         {SPOILT(a.center.stride_bytes = 4; a.radius.stride_bytes = 3; a.motion.stride_bytes = 23;
                 a.material.stride_bytes = 1; a.color = (pt_column{a.color.data, 2, PT_TYPE_SRGB8})),
          "sphere_arrays[0].center.stride_bytes = 4: must be 0 or at least the 12 bytes of one element\n"
          "sphere_arrays[0].radius.stride_bytes = 3: must be 0 or at least the 4 bytes of one element\n"
          "sphere_arrays[0].motion.stride_bytes = 23: must be 0 or at least the 24 bytes of one element\n"
          "sphere_arrays[0].material.stride_bytes = 1: must be 0 or at least the 4 bytes of one element\n"
          "sphere_arrays[0].color.stride_bytes = 2: must be 0 or at least the 3 bytes of one element"},
         {SPOILT(a.color.stride_bytes = 1U << 31), "sphere_arrays[0].color.stride_bytes = 2147483648: must be < 2^31"},
         {SPOILT(a.end = a.center; a.end.type = PT_TYPE_UINT32),
          "sphere_arrays[0].end.type = 3: " + real +
              "\nsphere_arrays[0].motion.data = set: must be NULL with end.data, because capsules do not move"}});
}

TEST(SphereArrays, BrokenRulesOfValuesAreNamed) {
    expect_refusals<Particles>(
        {}, outcome,
        {{[](Particles &p) {
              p.center[3] = -1e-19F;
              p.center[7] = not_a_number;
              p.radius[0] = 0;
              p.radius[1] = not_a_number;
              p.radius[3] = 1e-20F;
              p.motion[2] = 1e-300;
              p.material[2] = 3;
              p.color[2] = not_a_number;
              p.color[9] = -0.01F;
          },
          "sphere_arrays[0].center[1] = (-1e-19, 5, 6): must be 0 or of a magnitude in [1e-18, 1e18]\n"
          "sphere_arrays[0].center[2] = (-7, nan, 9): must be finite\n"
          "sphere_arrays[0].radius[0] = 0: must be > 0\n"
          "sphere_arrays[0].radius[1] = nan: must be finite\n"
          "sphere_arrays[0].radius[3] = 1e-20: must lie in [1e-18, 1e18]\n"
          "sphere_arrays[0].motion[0] = (0, 0, 1e-300): must be 0 or of a magnitude in [1e-18, 1e18]\n"
          "sphere_arrays[0].material[2] = 3: must be < material_count (3)\n"
          "sphere_arrays[0].color[0] = (1, 1, nan): must be finite\n"
          "... and 1 more"},
         {[](Particles &p) { p.color[9] = -0.01F; }, "sphere_arrays[0].color[3] = (-0.01, 1, 0.5): must lie in [0, 1]"},
         {[](Particles &p) {
              p.materials.clear();
              p.spoil = [](pt_sphere_array &a) { a.material = {}; };
          },
          "sphere_arrays[0].material = 0: must be < material_count (0)"},
         {[](Particles &p) {
              p.radius = {-1};
              p.spoil = [](pt_sphere_array &a) { a.radius.stride_bytes = 0; };
          },
          "sphere_arrays[0].radius[0] = -1: must be > 0"},
         {[](Particles &p) {
              p.motion[6] = -std::numeric_limits<double>::infinity();
              p.spoil = [](pt_sphere_array &a) {
                  a.end = a.motion;
                  a.motion = {};
              };
          },
          "sphere_arrays[0].end[2] = (-inf, 0, 0): must be finite\n"
          "sphere_arrays[0].material[1] = 2: must be a material without emission, because capsules cannot be lamps"}});
}

const void *const not_there = reinterpret_cast<const void *>(std::uintptr_t{64}); // Reading this address would crash.

TEST(SphereArrays, BrokenRulesOfCountsAreNamed) {
    expect_refusals<Particles>(
        {}, outcome,
        {{[](Particles &p) { p.spoil_scene = [](pt_scene &s) { s.sphere_arrays = nullptr; }; },
          "scene.sphere_arrays = NULL: must not be NULL, as sphere_array_count is 1"},
         {[](Particles &p) {
              p.spoil_scene = [](pt_scene &s) {
                  s.sphere_arrays = static_cast<const pt_sphere_array *>(not_there);
                  s.sphere_array_count = 65537;
              };
          },
          "scene.sphere_array_count = 65537: must be <= 65536"},
         {[](Particles &p) { p.spoil_scene = [](pt_scene &s) { s.reserved = 1; }; }, "scene.reserved = 1: must be 0"},
         {[](Particles &p) {
              p.spoil_scene = [](pt_scene &s) {
                  s.spheres = static_cast<const pt_sphere *>(not_there);
                  s.sphere_count = (1U << 26) - 3;
              };
          },
          "scene.sphere_count + the counts of sphere_arrays = 67108865: must be <= 2^26"},
         {[](Particles &p) {
              p.spoil = [](pt_sphere_array &a) { a.count = 4294967295U; };
              p.spoil_scene = [](pt_scene &s) { s.sphere_count = 5; };
          },
          "scene.sphere_count + the counts of sphere_arrays = 4294967300: must be <= 2^26\n"
          "scene.plane_count + all spheres = 4294967300: must be < 2^30"}});
}

#undef SPOILT

TEST(SphereArrays, AreNamedByTheirIndex) {
    Particles particles;
    std::array<pt_sphere_array, 3> arrays{};
    arrays.fill(particles.array());
    const float bad = -1;
    arrays[1].radius = {&bad, 0, PT_TYPE_FLOAT32};
    arrays[2].center.type = 9;
    const pt::Error error = error_of([&] { particles.validated(arrays); });
    EXPECT_STREQ(error.what(), "sphere_arrays[1].radius[0] = -1: must be > 0\n"
                               "sphere_arrays[2].center.type = 9: must be PT_TYPE_FLOAT32 (1) or PT_TYPE_FLOAT64 (2)");
    const pt::BrokenRule &rule = error.broken_rules()->first()[0];
    EXPECT_EQ(rule.subject, "sphere_arrays");
    EXPECT_EQ(rule.index, 1);
    EXPECT_EQ(rule.member, "radius");
    EXPECT_EQ(rule.component, 0);
    arrays[1].struct_size = 40;
    const pt::Error unlike = error_of([&] { particles.validated(arrays); });
    EXPECT_EQ(unlike.code(), PT_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(unlike.what(), "sphere_arrays[1].struct_size = 40: must be equal to that of sphere_arrays[0] (120)");
}

} // namespace

} // namespace sphere_arrays
