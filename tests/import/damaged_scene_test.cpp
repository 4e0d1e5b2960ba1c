// Scenes of other programs that were cut short or changed are refused with a line, or read as what they say.
#include "tests/import/imported.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

constexpr int damage_count = 200;

const std::string whole_nff = "v\nfrom 2.1 1.3 1.7\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 16 16\n"
                              "b 0.078 0.361 0.753\nl 4 3 2\nl 1 -4 4 0.5 0.5 0.5\nf 1 0.9 0.7 0.5 0.5 45.2776 0 0\n"
                              "s 0 0 0 0.5\ns 0.27 0.27 0.54 0.16\n";

// The number of surfaces; -1 if it is refused.
int surface_count(const std::string &text, const std::string &name) {
    try {
        const cli::SceneFile scene = cli::parse_scene(text, name);
        for (const pt_sphere &sphere : scene.spheres)
            EXPECT_TRUE(std::isfinite(sphere.center[0] + sphere.center[1] + sphere.center[2]) && sphere.radius > 0.0);
        EXPECT_TRUE(std::all_of(scene.materials.begin(), scene.materials.end(), [](const pt_material &each) {
            return std::isfinite(each.emission[0]) && each.emission[0] >= 0.0F && each.diffuse[0] >= 0.0F;
        }));
        return static_cast<int>(scene.spheres.size() + scene.planes.size());
    } catch (const cli::Failure &failure) {
        EXPECT_EQ(failure.code(), cli::ExitCode::scene) << failure.what();
        EXPECT_EQ(std::string(failure.what()).rfind(name, 0), 0U) << failure.what();
        return -1;
    }
}

TEST(DamagedScene, CutShortIsRefused) {
    std::mt19937 random(1);
    const std::string text = imported::text_of("parallel.dat");
    const int whole = surface_count(text, "a.dat");
    const std::size_t last = text.find("END_SCENE") + 9;
    for (int i = 0; i < damage_count; ++i) {
        const std::size_t size = std::uniform_int_distribution<std::size_t>(0, text.size() - 1)(random);
        EXPECT_EQ(surface_count(text.substr(0, size), "a.dat"), size < last ? -1 : whole) << size;
    }
    // NFF has no end: at the end of an entity it can be cut unseen.
    for (std::size_t size = 0; size < whole_nff.size(); ++size)
        EXPECT_LE(surface_count(whole_nff.substr(0, size), "a.nff"), surface_count(whole_nff, "a.nff")) << size;
    EXPECT_EQ(surface_count(whole_nff.substr(0, whole_nff.size() - 6), "a.nff"), -1);
}

TEST(DamagedScene, ChangedBytesDoNoHarm) {
    std::mt19937 random(2);
    const std::string tachyon = imported::text_of("perspective.dat");
    for (const bool is_nff : {false, true}) {
        const std::string &text = is_nff ? whole_nff : tachyon;
        const auto below = [&random](std::size_t end) {
            return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
        };
        int refused = 0;
        for (int i = 0; i < damage_count; ++i) {
            std::string changed = text;
            const std::size_t end = i % 2 == 0 ? changed.size() : 120; // half of them in the camera
            for (int change = 0; change <= i % 3; ++change)
                changed[below(end)] = "0123456789.-+eE# \nvbfls\xff"[below(24)];
            refused += surface_count(changed, is_nff ? "a.nff" : "a.dat") < 0 ? 1 : 0;
        }
        EXPECT_GT(refused, damage_count / 4);
        EXPECT_LT(refused, damage_count);
    }
}

} // namespace
