#include "tests/invariance/invariance_scene.h"
#include "tests/support/context_fixture.h"
#include "tests/support/render_image.h"
#include "tests/support/shared_context.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

constexpr uint32_t width = 64;
constexpr uint32_t height = 32;

using Image = std::vector<float>;

std::size_t differing_values(const Image &a, const Image &b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        count += a[i] != b[i];
    return count;
}

InvarianceScene scene_of_many_lamps() {
    InvarianceScene result = InvarianceScene::coursework();
    for (int i = 0; i < 6; ++i)
        result.spheres.push_back({{3.0 * i - 8.0, 5.5, -10.5 + i}, 0.25, {0, 0, 0}, static_cast<uint32_t>(i % 2), 0});
    return result;
}

InvarianceScene large_scene() {
    InvarianceScene result = InvarianceScene::coursework();
    result.planes.resize(2);
    std::fill_n(result.materials[result.planes[1].material].emission, 3, 0.25F);
    result.camera.shutter_close = 1.0;
    const auto material = result.spheres.back().material;
    for (int i = 0; i < 300; ++i)
        result.spheres.push_back({{i % 20 - 9.5, i / 20 * 0.5 - 3.5, -14.0}, 0.2, {0, 0, 0}, material, 0});
    return result;
}

struct Picture {
    const char *name;
    InvarianceScene (*scene)();
    bool has_tree;
};

class Invariance : public ContextFixture, public testing::WithParamInterface<Picture> {
protected:
    static InvarianceScene scene() { return GetParam().scene(); }

    Context create_fixtures_context() override {
        return create_context([](pt_create_info &) {}, GetParam().has_tree ? &create_with_tree : &create_without_tree);
    }

    Image image_of(const InvarianceScene &scene) {
        return render_image(context(), scene.scene(), scene.camera, render_of(width, height, 4), 16);
    }

    void SetUp() override {
        ContextFixture::SetUp();
        original_ = image_of(scene());
        InvarianceScene changed = scene();
        changed.spheres[2].radius *= 1.03;
        EXPECT_GT(differing_values(image_of(changed), original_), 100U);
    }

    void expect_same_bits(const InvarianceScene &changed) {
        EXPECT_EQ(differing_values(image_of(changed), original_), 0U);
    }

private:
    Image original_;
};

// Powers of two change no mantissa. Some of these scales would reveal a fixed length in the kernel.
TEST_P(Invariance, UnitOfLength) {
    for (const int exponent : {-50, -20, -4, 20, 50}) {
        SCOPED_TRACE(exponent);
        InvarianceScene scaled = scene();
        scaled.scale(std::ldexp(1.0, exponent));
        expect_same_bits(scaled);
    }
}

// Positions relative to the camera are computed in double. Here the sums are exact.
TEST_P(Invariance, Origin) {
    const double ways[][3] = {
        {1048576, -524288, 262144.5}, {1e6, -1e6, 1e6}, {-999999.5, 123456.25, 0.125}, {0, 3, -65536}};
    for (const double(&way)[3] : ways) {
        SCOPED_TRACE(way[0]);
        InvarianceScene moved = scene();
        moved.translate(way);
        expect_same_bits(moved);
    }
}

// Translated coordinates near 1e6 are rounded in double, by up to 2^-34. This can change the rounding of a float32 near
// 1, and then its value by 2^-23. The ends of rays then move by up to 1e-6 of the scene's size. A few of the 2048 * 16
// paths then hit another surface. Each path has about 1e-5 of the light. The light of the other paths changes by about
// 1e-6.
TEST_P(Invariance, OriginRounded) {
    InvarianceScene original = scene();
    original.turn({{0.36, 0.48, -0.8}, {-0.8, 0.6, 0}, {0.48, 0.64, 0.6}});
    const Image unmoved = image_of(original);
    InvarianceScene moved = original;
    moved.translate({1e6 / 3, -1e6 / 7, 1e6 / 11});
    const Image image = image_of(moved);
    double sum = 0.0;
    double difference = 0.0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        sum += unmoved[i];
        difference += image[i] - unmoved[i];
    }
    EXPECT_LT(std::abs(difference), 1e-4 * sum);
    InvarianceScene changed = moved;
    changed.brighten(1.001F);
    double brighter = 0.0;
    for (const float value : image_of(changed))
        brighter += value;
    EXPECT_GT(brighter - sum, 1e-4 * sum);
}

TEST_P(Invariance, OrderOfMaterials) {
    InvarianceScene reordered = scene();
    reordered.reverse_materials();
    expect_same_bits(reordered);
    InvarianceScene added = scene();
    added.materials.push_back(added.materials[0]);
    expect_same_bits(added);
}

using InvarianceOfLargeScenes = Invariance;

TEST_P(InvarianceOfLargeScenes, SharedMaterials) {
    InvarianceScene own = scene();
    own.materials.clear();
    const auto give_own = [&](uint32_t &material) {
        own.materials.push_back(scene().materials[material]);
        material = static_cast<uint32_t>(own.materials.size()) - 1;
    };
    for (pt_sphere &sphere : own.spheres)
        give_own(sphere.material);
    for (pt_plane &plane : own.planes)
        give_own(plane.material);
    expect_same_bits(own);
    EXPECT_EQ(stats().features, PT_FEATURE_LAMPS | PT_FEATURE_GLOSS | PT_FEATURE_MOTION | PT_FEATURE_LARGE |
                                    (GetParam().has_tree ? PT_FEATURE_TREE : 0));
}

const auto name_of = [](const auto &param) { return param.param.name; };

INSTANTIATE_TEST_SUITE_P(Held, InvarianceOfLargeScenes,
                         testing::Values(Picture{"InATree", &large_scene, true},
                                         Picture{"InALine", &large_scene, false}),
                         name_of);

INSTANTIATE_TEST_SUITE_P(Scenes, Invariance,
                         testing::Values(Picture{"Coursework", &InvarianceScene::coursework, false},
                                         Picture{"ManyLamps", &scene_of_many_lamps, false},
                                         Picture{"Tree", &scene_of_many_lamps, true}),
                         name_of);

} // namespace
