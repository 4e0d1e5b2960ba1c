#include "lib/scene/scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace {

pt::Scene small_scene() {
    return {{{glm::vec3(0.5F), glm::vec3(0.25F), glm::vec3(0), 40.0F}, {glm::vec3(0), glm::vec3(0), glm::vec3(1), 0}},
            {{{0, 1, -5}, 1, {0, 0.5, 0}, 0}, {{0, 9, -5}, 2, {0, 0, 0}, 1}},
            {{{0, 1, 0}, 0.25, 0}}};
}

TEST(SceneDigest, DependsOnEveryNumber) {
    const std::string digest = pt::digest_of(small_scene());
    EXPECT_EQ(digest, pt::digest_of(small_scene()));
    const std::function<void(pt::Scene &)> changes[] = {
        [](pt::Scene &scene) { scene.materials[0].diffuse.r = 0.75F; },
        [](pt::Scene &scene) { scene.materials[0].specular.g = 0.75F; },
        [](pt::Scene &scene) { scene.materials[1].emission.b = 0.75F; },
        [](pt::Scene &scene) { scene.materials[1].glossiness = 1.0F; },
        [](pt::Scene &scene) { scene.materials[1].hidden = true; },
        [](pt::Scene &scene) { scene.spheres[0].center.z = -6; },
        [](pt::Scene &scene) { scene.spheres[0].motion.x = 1; },
        [](pt::Scene &scene) { scene.spheres[1].radius = 3; },
        [](pt::Scene &scene) { scene.spheres[1].material = 0; },
        [](pt::Scene &scene) { scene.spheres.pop_back(); },
        [](pt::Scene &scene) { scene.planes[0].normal.y = -1; },
        [](pt::Scene &scene) { scene.planes[0].offset = 0; },
        [](pt::Scene &scene) { scene.planes[0].material = 1; },
    };
    for (std::size_t i = 0; i < std::size(changes); ++i) {
        pt::Scene changed = small_scene();
        changes[i](changed);
        EXPECT_NE(pt::digest_of(changed), digest) << "change " << i;
    }
}

TEST(SceneDigest, DoesNotDependOnTheListOfMaterials) {
    const std::string digest = pt::digest_of(small_scene());
    pt::Scene unused = small_scene();
    unused.materials.push_back({});
    EXPECT_EQ(pt::digest_of(unused), digest);
    pt::Scene swapped = small_scene();
    std::swap(swapped.materials[0], swapped.materials[1]);
    EXPECT_NE(pt::digest_of(swapped), digest);
    swapped.spheres[0].material = swapped.planes[0].material = 1;
    swapped.spheres[1].material = 0;
    EXPECT_EQ(pt::digest_of(swapped), digest);
    pt::Scene repeated = small_scene();
    repeated.materials.push_back(repeated.materials[0]);
    repeated.planes[0].material = 2;
    EXPECT_EQ(pt::digest_of(repeated), digest);
    repeated.materials[0].diffuse.r = repeated.materials[2].diffuse.r = 0.0F;
    const std::string zero = pt::digest_of(repeated);
    EXPECT_NE(zero, digest);
    repeated.materials[2].diffuse.r = -0.0F;
    EXPECT_EQ(pt::digest_of(repeated), zero);
}

} // namespace
