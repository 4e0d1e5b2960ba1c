#include "tests/invariance/invariance_scene.h"
#include "tests/kernel/kernel_render.h"
#include "tests/kernel/table_words.h"
#include "tests/support/context_fixture.h"
#include "tests/support/render_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace {

namespace gpu = pt::gpu;

using FilmWords = KernelRender::FilmWords;

constexpr std::uint32_t source_width = KernelRender::width;
constexpr std::uint32_t source_height = KernelRender::height;
constexpr std::uint32_t sample_count = KernelRender::most_samples;

struct Comparison {
    const KernelRender &render;
    const FilmWords film;

    explicit Comparison(const KernelRender &of) : render(of), film(of.film(gpu::SCENE_IN_CONSTANTS, of.words())) {
        EXPECT_LE(of.words().size(), gpu::CONSTANT_SCENE_WORDS);
        EXPECT_EQ(film[std::size_t{gpu::FILM_ACCEPTED} * source_width * source_height], sample_count);
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

class SceneSourceTest : public ContextFixture {
protected:
    static std::vector<float> image_of(pt_context *on, const InvarianceScene &source) {
        return render_image(on, source.scene(), source.camera, ::render_of(source_width, source_height, 4),
                            sample_count);
    }
};

TEST_F(SceneSourceTest, TheSceneBeforeDoesNotMatter) {
    const InvarianceScene before = scene_with_lamps(2);
    InvarianceScene after = before;
    after.spheres[0].center[0] += 0.5;
    const std::vector<float> of_before = image_of(context(), before);
    const std::vector<float> of_after = image_of(context(), after);
    const Context fresh = create_context();
    EXPECT_TRUE(image_of(fresh.get(), after) == of_after);
    EXPECT_TRUE(image_of(context(), before) == of_before) << "again";
    EXPECT_FALSE(of_before == of_after);
}

} // namespace
