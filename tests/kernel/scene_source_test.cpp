#include "tests/invariance/invariance_scene.h"
#include "tests/kernel/kernel_render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

namespace gpu = pt::gpu;

using FilmWords = KernelRender::FilmWords;

// The material index of surface i is component i mod 4 of the word first_index_word + i / 4.
std::size_t first_index_word(const pt::Features &features) {
    const std::size_t emitting =
        features.emitting_spheres() + (features[gpu::ID_PLANES_EMIT] ? features[gpu::ID_PLANE_COUNT] : 0);
    return features.surface_count() + emitting + (features[gpu::ID_MOTION] ? features[gpu::ID_SPHERE_COUNT] : 0) +
           (features[gpu::ID_CURVATURE] ? features[gpu::ID_PLANE_COUNT] : 0);
}

std::vector<glm::vec4> table_words(const pt::Features &features, const std::vector<glm::vec4> &words) {
    const std::size_t surfaces = features.surface_count();
    const std::size_t reflection = features[gpu::ID_GLOSS] ? 2 : 1;
    const auto emission = words.begin() + static_cast<std::ptrdiff_t>(surfaces);
    std::vector<glm::vec4> result(words.begin(), emission);
    result.insert(result.end(), emission, emission + features.emitting_spheres());
    if (features[gpu::ID_PLANES_EMIT])
        result.insert(result.end(), emission + features[gpu::ID_SPHERE_COUNT],
                      emission + static_cast<std::ptrdiff_t>(surfaces));
    result.insert(result.end(), emission + static_cast<std::ptrdiff_t>((1 + reflection) * surfaces), words.end());
    result.resize(first_index_word(features) + (surfaces + 3) / 4);
    for (std::uint32_t i = 0; i < surfaces; ++i)
        result[first_index_word(features) + i / 4][static_cast<int>(i % 4)] =
            std::bit_cast<float>(gpu::MATERIAL_INDEX_BITS + i);
    for (std::size_t i = 0; i < surfaces; ++i)
        for (std::size_t part = 0; part < reflection; ++part)
            result.push_back(words[(2 + part) * surfaces + i]);
    return result;
}

struct Comparison {
    const KernelRender &render;
    const FilmWords film;

    explicit Comparison(const KernelRender &of) : render(of), film(of.film(gpu::SCENE_IN_CONSTANTS, of.words())) {
        EXPECT_LE(of.words().size(), gpu::CONSTANT_SCENE_WORDS);
        EXPECT_EQ(film[std::size_t{gpu::FILM_ACCEPTED} * KernelRender::width * KernelRender::height],
                  KernelRender::most_samples);
    }

    bool holds(std::uint32_t source, const std::vector<glm::vec4> &words) const {
        return render.film(source, words) == film;
    }

    bool holds_in_storage() const {
        return holds(gpu::SCENE_IN_STORAGE, table_words(render.features(), render.words()));
    }

    bool holds_in_storage_with(std::uint32_t constant) const {
        KernelRender::Constants constants = render.constants();
        constants[constant] = 1;
        return render.film_of_kernel(constants, gpu::SCENE_IN_STORAGE,
                                     table_words(render.features(), render.words())) == film;
    }
};

InvarianceScene scene_with_lamps(int lamp_count) {
    InvarianceScene scene = InvarianceScene::coursework();
    scene.planes.resize(1);
    scene.spheres = {{{-2, -2, -12}, 3, {0, 0, 0}, 2, 0}};
    for (int i = 0; i < lamp_count; ++i)
        scene.spheres.push_back({{3.0 * i - 8.0, 4, -10.5}, 0.5, {0, 0, 0}, static_cast<uint32_t>(i % 2), 0});
    return scene;
}

InvarianceScene diffuse_scene() {
    InvarianceScene scene = scene_with_lamps(gpu::EVERY_LAMP_LIMIT + 1);
    for (pt_material &material : scene.materials)
        std::fill_n(material.specular, 3, 0.0F);
    return scene;
}

// Skips devices that read scenes only from buffers, because their rounding may depend on the kind of memory.
class SceneSource : public testing::Test {
protected:
    void SetUp() override {
        if (!probe_device().policy().scene_in_constants)
            GTEST_SKIP() << "this device reads scenes from buffers alone";
    }
};

TEST_F(SceneSource, KeepsTheBitsOfADiffuseSceneWithManyLamps) {
    const KernelRender render = render_of_scene(diffuse_scene());
    EXPECT_FALSE(render.features()[gpu::ID_MOTION] || render.features()[gpu::ID_GLOSS] ||
                 render.features()[gpu::ID_CURVATURE]);
    EXPECT_GT(render.features()[gpu::ID_LAMP_COUNT], gpu::EVERY_LAMP_LIMIT);
    const Comparison same(render);
    EXPECT_TRUE(same.holds(gpu::SCENE_IN_UNIFORM, render.words()));
    EXPECT_TRUE(same.holds_in_storage());

    // Negative control: the last bit of a radius changes.
    std::vector<glm::vec4> words = render.words();
    float &radius = words[render.features()[gpu::ID_LAMP_COUNT]].w;
    radius = std::nextafter(radius, std::numeric_limits<float>::infinity());
    EXPECT_FALSE(same.holds(gpu::SCENE_IN_UNIFORM, words));
    EXPECT_FALSE(same.holds(gpu::SCENE_IN_CONSTANTS, words));
    EXPECT_FALSE(same.holds(gpu::SCENE_IN_STORAGE, table_words(render.features(), words)));

    std::vector<glm::vec4> table = table_words(render.features(), render.words());
    const std::uint32_t ball = render.features()[gpu::ID_LAMP_COUNT];
    const std::uint32_t floor = render.features().surface_count() - 1;
    ASSERT_EQ(floor, ball + 1);
    glm::vec4 *const indices = &table[first_index_word(render.features())];
    indices[floor / 4][static_cast<int>(floor % 4)] = indices[ball / 4][static_cast<int>(ball % 4)];
    EXPECT_FALSE(same.holds(gpu::SCENE_IN_STORAGE, table));
}

// All numbers are constants, so compilers may reorder products.
TEST_F(SceneSource, KeepsTheBitsWithOneLampMotionGlossAndAHugeSphere) {
    InvarianceScene scene = scene_with_lamps(1);
    scene.camera.shutter_close = 1.0;
    scene.spheres[0].motion[1] = 0.5;
    scene.spheres[1].motion[0] = 1.5;
    scene.spheres.push_back({{0, -1002.5, -8}, 1000, {0, 0, 0}, scene.planes[0].material, 0});
    const KernelRender render = render_of_scene(scene);
    EXPECT_TRUE(render.features()[gpu::ID_MOTION] && render.features()[gpu::ID_GLOSS] &&
                render.features()[gpu::ID_CURVATURE]);
    const Comparison same(render);
    EXPECT_TRUE(same.holds(gpu::SCENE_IN_UNIFORM, render.words()));
    EXPECT_TRUE(same.holds_in_storage());
    EXPECT_TRUE(same.holds_in_storage_with(gpu::ID_UNIFORM_READS));
    EXPECT_TRUE(same.holds_in_storage_with(gpu::ID_INTEGER_ORDER));
    EXPECT_TRUE(render.film_by_driver(gpu::SCENE_IN_UNIFORM) == same.film) << "whoever fills the constants in";
}

// Compilers may unite surfaces with equal numbers.
TEST_F(SceneSource, KeepsTheBitsOfSurfacesOfOneMaterial) {
    InvarianceScene alike = scene_with_lamps(2);
    std::fill_n(alike.materials[3].diffuse, 3, 0.3F);
    std::fill_n(alike.materials[3].specular, 3, 0.37F);
    std::fill_n(alike.materials[3].emission, 3, 0.7F);
    for (pt_sphere &sphere : alike.spheres)
        sphere.material = 3;
    for (pt_plane &plane : alike.planes)
        plane.material = 3;
    InvarianceScene single = alike;
    single.planes.clear();
    single.spheres = {{{1, 2, 3}, 17, {0, 0, 0}, 3, 0}};
    for (const InvarianceScene &scene : {alike, single}) {
        const KernelRender render = render_of_scene(scene);
        EXPECT_TRUE(render.features()[gpu::ID_GLOSS]);
        EXPECT_EQ(render.features().surface_count(), scene.spheres.size() + scene.planes.size());
        const Comparison same(render);
        EXPECT_TRUE(same.holds(gpu::SCENE_IN_UNIFORM, render.words()));
        EXPECT_TRUE(same.holds_in_storage());
    }
}

} // namespace
