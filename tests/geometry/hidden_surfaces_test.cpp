#include "lib/view/scene_features.h"
#include "lib/view/view.h"

#include <gtest/gtest.h>
#include <pt/stats.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace hidden_surfaces {

namespace {

enum Kind : std::uint32_t { Dark, Lamp, HiddenDark, HiddenLamp };

pt::Features features_of(std::vector<pt::Sphere> spheres, std::vector<pt::Plane> planes = {}) {
    pt::Scene scene;
    for (const auto &[emission, hidden] : {std::pair{0.0F, false}, {1.0F, false}, {0.0F, true}, {1.0F, true}})
        scene.materials.push_back({glm::vec3(0.5F), glm::vec3(0), glm::vec3(emission), 0, hidden});
    scene.spheres = std::move(spheres);
    scene.planes = std::move(planes);
    const pt::Camera camera{glm::dvec3(0.0), {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5, 0.0, 1.0};
    return pt::view_of(pt::PreparedScene(scene), camera, {4, 4, 2, 0, 0, PT_ESTIMATOR_MIS, PT_SAMPLER_RANDOM, 0, 4})
        .features;
}

pt::Sphere sphere(double z, double radius, Kind kind) {
    return {{0, 0, z}, radius, glm::dvec3(0.0), kind};
}

TEST(HiddenSurfaces, AreCountedByKind) {
    const pt::Features features =
        features_of({sphere(-5, 1, HiddenDark), sphere(-9, 1, HiddenLamp), sphere(-12, 1, Lamp), sphere(-15, 1, Dark),
                     sphere(0, 90, HiddenLamp), sphere(0, 80, Lamp)},
                    {{{0, 1, 0}, 3, Dark}, {{0, 1, 0}, 7, HiddenDark}});
    EXPECT_EQ(features[pt::gpu::ID_LAMP_COUNT], 2U);
    EXPECT_EQ(features[pt::gpu::ID_SKY_COUNT], 2U);
    EXPECT_EQ(features[pt::gpu::ID_HIDDEN_LAMPS], 1U);
    EXPECT_EQ(features[pt::gpu::ID_HIDDEN_SKIES], 1U);
    EXPECT_EQ(features[pt::gpu::ID_HIDDEN_OTHERS], 1U);
    EXPECT_EQ(features[pt::gpu::ID_HIDDEN_PLANES], 1U);
    EXPECT_TRUE(pt::feature_bits(features) & PT_FEATURE_HIDDEN);
    EXPECT_FALSE(pt::feature_bits(features_of({sphere(-5, 1, Dark)})) & PT_FEATURE_HIDDEN);
}

TEST(HiddenSurfaces, LyingApartLeaveTheKernelAsItIs) {
    const auto with = [](Kind lamp) {
        return features_of({sphere(-5, 1, Dark), sphere(-9, 1, lamp)}, {{{0, 1, 0}, 3, Dark}});
    };
    pt::Features hidden = with(HiddenLamp);
    EXPECT_EQ(std::exchange(hidden[pt::gpu::ID_HIDDEN_LAMPS], 0), 1U);
    EXPECT_EQ(hidden, with(Lamp));
}

TEST(HiddenSurfaces, WithPathsOnBothSidesAreMetFromBoth) {
    const pt::Features into = features_of({sphere(-5, 1, Dark), sphere(-5, 2, HiddenDark)});
    EXPECT_TRUE(into[pt::gpu::ID_INSIDE]);
    EXPECT_FALSE(into[pt::gpu::ID_KNOWN_SIDES]);
    const pt::Features out_of = features_of({sphere(-5, 1, Dark), sphere(0, 2, HiddenDark)});
    EXPECT_FALSE(out_of[pt::gpu::ID_INSIDE]);
    EXPECT_FALSE(out_of[pt::gpu::ID_KNOWN_SIDES]);
    const pt::Features at_a_wall = features_of({sphere(-5, 1, HiddenDark)}, {{{0, 0, 1}, 5.5, Dark}});
    EXPECT_TRUE(at_a_wall[pt::gpu::ID_INSIDE]);
    EXPECT_FALSE(features_of({sphere(-5, 1, HiddenDark)}, {{{0, 0, 1}, 6.5, Dark}})[pt::gpu::ID_INSIDE]);
    const pt::Features through = features_of({sphere(-5, 1, Dark), sphere(-5, 2, Dark)}, {{{0, 0, 1}, 2, HiddenDark}});
    EXPECT_TRUE(through[pt::gpu::ID_PLANES_BLOCK]);
    EXPECT_FALSE(through[pt::gpu::ID_KNOWN_SIDES]);
    const auto leaving = [](double way) {
        return features_of({{{0, 0, -5}, 3, {0, 0, way}, Dark}, sphere(-5, 1, HiddenDark)});
    };
    EXPECT_FALSE(leaving(-1)[pt::gpu::ID_INSIDE]);
    EXPECT_TRUE(leaving(-6)[pt::gpu::ID_INSIDE]) << "within the ball at first";
    const auto in_a_room = [](Kind wall) { return features_of({sphere(0, 50, Dark)}, {{{0, 0, 1}, 2, wall}}); };
    EXPECT_TRUE(in_a_room(Dark)[pt::gpu::ID_KNOWN_SIDES]);
    EXPECT_FALSE(in_a_room(HiddenDark)[pt::gpu::ID_KNOWN_SIDES]);
}

TEST(HiddenSurfaces, ThatAreCapsulesAreMetAllAlong) {
    const auto with = [](double z, bool is_swept) {
        const pt::Sphere hidden{{0, 0, z}, 1, {0, 0, 6}, HiddenDark, is_swept ? pt::Kind::capsule : pt::Kind::ball};
        return features_of({{{0, 0, -20}, 1, {0, 0, 6}, Dark}, hidden});
    };
    EXPECT_FALSE(with(-23, false)[pt::gpu::ID_INSIDE]);
    EXPECT_TRUE(with(-23, true)[pt::gpu::ID_INSIDE]);
    EXPECT_FALSE(with(-40, true)[pt::gpu::ID_INSIDE]);
}

TEST(HiddenSurfaces, ALampAtTheCameraIsSampledUnlessPathsAreInIt) {
    for (const double radius : {0.1, 50.0}) {
        const pt::Features features = features_of({sphere(-5, 1, Dark), sphere(0, radius, HiddenLamp)});
        EXPECT_EQ(features[pt::gpu::ID_HIDDEN_LAMPS], radius < 1.0 ? 1U : 0U);
        EXPECT_EQ(features[pt::gpu::ID_HIDDEN_SKIES], radius < 1.0 ? 0U : 1U);
    }
}

} // namespace

} // namespace hidden_surfaces
