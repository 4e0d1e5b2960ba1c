#include "lib/scene/checked_scene.h"

#include "tests/geometry/refusals.h"
#include "tests/support/checked_scene_of.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr float nan_float = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity_float = std::numeric_limits<float>::infinity();

struct Draft {
    std::vector<pt_material> materials = std::vector<pt_material>(
        5, pt_material{{0.5F, 0.5F, 0.5F}, {0.25F, 0.25F, 0.25F}, {0.0F, 1.0F, 2.0F}, 10.0F, 0});
    std::vector<pt_sphere> spheres = std::vector<pt_sphere>(4, pt_sphere{{1, 2, 3}, 4, {5, 6, 7}, 1, 0});
    std::vector<pt_plane> planes = std::vector<pt_plane>(2, pt_plane{{0, 1, 0}, 2, 2, 0});
    std::function<void(pt_scene &)> spoil = [](pt_scene &) {};

    pt::Scene validated() const {
        pt_scene scene = scene_of(materials, spheres, planes);
        spoil(scene);
        return pt::owned_scene(checked_scene_of(scene));
    }
};

std::string scene_outcome(const Draft &draft) {
    return outcome_of(PT_ERROR_INVALID_SCENE, [&] { draft.validated(); });
}

TEST(Scene, BrokenRulesOfMaterialsAreNamedBeforeThoseOfSurfaces) {
    expect_refusals<Draft>(
        Draft(), scene_outcome,
        {{[](Draft &d) {
              d.materials[0].glossiness = -1.0F;
              d.materials[1].diffuse[2] = -0.5F;
              d.materials[2].specular[1] = infinity_float;
              d.materials[3].emission[0] = 1.1e18F;
              d.planes[0].reserved = 1;
              d.spheres[3].radius = -1;
          },
          "materials[0].glossiness = -1: must be >= 0\n"
          "materials[1].diffuse[2] = -0.5: must be >= 0\n"
          "materials[2].specular[1] = inf: must be finite\n"
          "materials[3].emission[0] = 1.1e+18: must be <= 1e18\n"
          "spheres[3].radius = -1: must be > 0\n"
          "planes[0].reserved = 1: must be 0"},
         {[](Draft &d) { d.materials[0].glossiness = -nan_float; }, "materials[0].glossiness = nan: must be finite"},
         {[](Draft &d) { d.materials[0].glossiness = 2e9F; }, "materials[0].glossiness = 2e+09: must be <= 1e9"},
         {[](Draft &d) { d.materials[4].flags = 6; },
          "materials[4].flags = 6: must be 0 or PT_MATERIAL_HIDDEN_FROM_CAMERA (1)"}});
}

TEST(Scene, BrokenRulesOfSpheresAreNamed) {
    expect_refusals<Draft>(
        Draft(), scene_outcome,
        {{[](Draft &d) {
              d.spheres[0].center[0] = 9e-19;
              d.spheres[0].radius = 0;
              d.spheres[1].motion[2] = -infinity;
              d.spheres[2].radius = infinity;
              d.spheres[2].material = 5;
              d.spheres[3].center[2] = -1.1e18;
              d.spheres[3].radius = 1e-19;
              d.spheres[3].reserved = 3;
          },
          "spheres[0].center[0] = 9e-19: must be 0 or of a magnitude in [1e-18, 1e18]\n"
          "spheres[0].radius = 0: must be > 0\n"
          "spheres[1].motion[2] = -inf: must be finite\n"
          "spheres[2].radius = inf: must be finite\n"
          "spheres[2].material = 5: must be < material_count (5)\n"
          "spheres[3].center[2] = -1.1e+18: must be 0 or of a magnitude in [1e-18, 1e18]\n"
          "spheres[3].radius = 1e-19: must lie in [1e-18, 1e18]\n"
          "spheres[3].reserved = 3: must be 0"},
         {[](Draft &d) { d.spheres[3].center[1] = nan; }, "spheres[3].center[1] = nan: must be finite"},
         {[](Draft &d) { d.spheres[3].motion[0] = -1e-300; },
          "spheres[3].motion[0] = -1e-300: must be 0 or of a magnitude in [1e-18, 1e18]"}});
}

TEST(Scene, BrokenRulesOfPlanesAreNamed) {
    const std::string length = "must be 0 or of a magnitude in [1e-18, 1e18] after division by the normal's length";
    expect_refusals<Draft>(
        Draft(), scene_outcome,
        {{[](Draft &d) { d.planes[0].normal[1] = 0; }, "planes[0].normal = (0, 0, 0): must not be zero"},
         {[](Draft &d) { d.planes[1].normal[0] = nan; }, "planes[1].normal[0] = nan: must be finite"},
         {[](Draft &d) { d.planes[1].offset = nan; }, "planes[1].offset = nan: must be finite"},
         {[](Draft &d) {
              d.planes[0] = {{0, 0, 20}, 1e-17, 0, 0};
          },
          "planes[0].offset = 1e-17: " + length},
         {[](Draft &d) {
              d.planes[1] = {{1e-300, 0, 0}, 1e300, 0, 0};
          },
          "planes[1].offset = 1e+300: " + length},
         {[](Draft &d) {
              d.planes[1] = {{0, 1e300, 0}, 1e-300, 0, 0};
          },
          "planes[1].offset = 1e-300: " + length},
         {[](Draft &d) { d.planes[1].material = 4294967295U; },
          "planes[1].material = 4294967295: must be < material_count (5)"},
         {[](Draft &d) { d.planes[1].reserved = 1; }, "planes[1].reserved = 1: must be 0"}});
}

TEST(Scene, BrokenRulesOfArraysAreNamed) {
    expect_refusals<Draft>(Draft(), scene_outcome,
                           {{[](Draft &d) { d.spoil = [](pt_scene &s) { s.spheres = nullptr; }; },
                             "scene.spheres = NULL: must not be NULL, as sphere_count is 4"},
                            {[](Draft &d) { d.spoil = [](pt_scene &s) { s.planes = nullptr; }; },
                             "scene.planes = NULL: must not be NULL, as plane_count is 2"},
                            {[](Draft &d) { d.spoil = [](pt_scene &s) { s.materials = nullptr; }; },
                             "scene.materials = NULL: must not be NULL, as material_count is 5"},
                            {[](Draft &d) { d.spoil = [](pt_scene &s) { s.plane_count = (1U << 30) - 4; }; },
                             "scene.plane_count + all spheres = 1073741824: must be < 2^30"},
                            {[](Draft &d) { d.spoil = [](pt_scene &s) { s.sphere_count = (1U << 26) + 1; }; },
                             "scene.sphere_count = 67108865: must be <= 2^26"},
                            {[](Draft &d) { d.spoil = [](pt_scene &s) { s.sphere_count = s.plane_count = 1U << 31; }; },
                             "scene.sphere_count = 2147483648: must be <= 2^26\n"
                             "scene.plane_count + all spheres = 4294967296: must be < 2^30"},
                            {[](Draft &d) {
                                 d.planes[0].reserved = 1;
                                 d.spoil = [](pt_scene &s) { s.spheres = nullptr; };
                             },
                             "scene.spheres = NULL: must not be NULL, as sphere_count is 4\n"
                             "planes[0].reserved = 1: must be 0"}});
}

TEST(Scene, AcceptsExtremes) {
    Draft draft;
    draft.materials[0] = {{0, 1e18F, 1e-45F}, {1e18F, 0, 0}, {0, -0.0F, 1e18F}, 1e9F, 0};
    draft.materials[1].glossiness = 0;
    draft.spheres[0] = {{1e18, -1e18, 1e-18}, 1e-18, {-1e-18, 0, 1e18}, 4, 0};
    draft.spheres[1] = {{0, -0.0, 0}, 1e18, {0, 0, 0}, 0, 0};
    draft.planes[0] = {{0, -1, 0}, 1e18, 4, 0};
    draft.planes[1] = {{0, -1, 0}, -1e-18, 4, 0};
    EXPECT_EQ(scene_outcome(draft), "accepted");
    EXPECT_TRUE(pt::owned_scene(checked_scene_of(scene_of({}, {}, {}))).spheres.empty());
}

TEST(Scene, NormalizesPlanesOfAnyScale) {
    const double denormal = std::numeric_limits<double>::denorm_min();
    const double largest = std::numeric_limits<double>::max();
    // Square, sum, root and division round once each by 2^-53.
    const double tolerance = 4 * 0x1p-53;
    for (const double scale : {1.0, 3.0, 1e300, 1e-300, 0x1p-1040, denormal, largest / 2}) {
        SCOPED_TRACE(scale);
        Draft draft;
        draft.planes = {{{scale, -2 * scale, 2 * scale}, 6 * std::min(scale, 1e290), 0, 0}};
        const pt::Plane plane = draft.validated().planes[0];
        EXPECT_NEAR(plane.normal.x, 1.0 / 3.0, tolerance);
        EXPECT_NEAR(plane.normal.y, -2.0 / 3.0, tolerance);
        EXPECT_NEAR(plane.normal.z, 2.0 / 3.0, tolerance);
        EXPECT_NEAR(plane.offset, 2.0 * (std::min(scale, 1e290) / scale), 2 * tolerance);
    }
}

} // namespace
