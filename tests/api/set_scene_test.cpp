#include "tests/support/context_calls.h"
#include "tests/support/context_fixture.h"
#include "tests/support/scene_of.h"

#include <pt/film.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace set_scene {

namespace {

constexpr std::uint32_t picture_width = 16;
constexpr std::uint32_t picture_height = 12;

struct Cloud {
    std::vector<pt_material> materials = {{{0.8F, 0.7F, 0.6F}, {0, 0, 0}, {0, 0, 0}, 0, 0},
                                          {{0, 0, 0}, {0, 0, 0}, {30, 30, 30}, 0, 0}};
    pt_sphere lamp{{1, 3, 2}, 0.5, {0, 0, 0}, 1, 0};
    std::vector<float> centers;
    float radius;
    pt_sphere_array array{};

    explicit Cloud(std::uint32_t count) : radius(0.8F / std::cbrt(static_cast<float>(count))) {
        std::mt19937 engine(31);
        for (std::uint32_t i = 0; i < 3 * count; ++i)
            centers.push_back(static_cast<float>(engine() >> 8) * 0x1p-23F - 1.0F);
    }

    // The returned scene points into this object.
    pt_scene scene() {
        array = array_of(centers.size() / 3, {centers.data(), 12, PT_TYPE_FLOAT32}, {&radius, 0, PT_TYPE_FLOAT32});
        return scene_of(materials, {&lamp, 1}, {}, {&array, 1});
    }

    void move() {
        std::mt19937 engine(37);
        for (float &coordinate : centers)
            coordinate += radius * (static_cast<float>(engine() >> 8) * 0x1p-24F - 0.5F) * 0.2F;
    }
};

constexpr std::uint32_t many = 30'000;

class SetSceneTest : public ContextFixture {
protected:
    struct Told {
        std::vector<double> shares;
        std::size_t most = SIZE_MAX;

        static std::int32_t receive(void *user, double share) {
            auto *const told = static_cast<Told *>(user);
            told->shares.push_back(share);
            return told->shares.size() > told->most ? 1 : 0;
        }
    };

    static pt_result set_telling(pt_context *on, pt_scene scene, Told &told) {
        scene.progress = &Told::receive;
        scene.progress_user = &told;
        return pt_set_scene(on, &scene);
    }

    static void set(pt_context *on, const pt_scene &scene) {
        ASSERT_EQ(pt_set_scene(on, &scene), PT_OK) << pt_last_error(on);
    }

    static void set_view(pt_context *on) {
        const pt_camera camera = camera_at({0, 0.5, 4}, {0, 0, 0});
        const pt_render render = render_of(picture_width, picture_height, 3);
        ASSERT_EQ(pt_set_camera(on, &camera), PT_OK) << pt_last_error(on);
        ASSERT_EQ(pt_set_render(on, &render), PT_OK) << pt_last_error(on);
    }

    static std::vector<char> film_of(pt_context *on, std::uint32_t sample_count) {
        accumulate_on(on, sample_count);
        return ::film_of(on);
    }
};

TEST_F(SetSceneTest, TellsHowFarItIs) {
    Cloud cloud(many);
    for (int round = 0; round < 3; ++round, cloud.move()) {
        Told told;
        ASSERT_EQ(set_telling(context(), cloud.scene(), told), PT_OK) << pt_last_error(context());
        EXPECT_GE(told.shares.size(), 2U);
        EXPECT_TRUE(std::ranges::is_sorted(told.shares));
        EXPECT_GT(told.shares.front(), 0.0);
        EXPECT_LT(told.shares.front(), 1.0);
        EXPECT_EQ(told.shares.back(), 1.0);
    }
    Told told;
    ASSERT_EQ(set_telling(context(), scene_of(cloud.materials, {&cloud.lamp, 1}, {}), told), PT_OK);
    EXPECT_EQ(told.shares, std::vector<double>{1.0});
    cloud.centers.back() = INFINITY;
    told = {};
    EXPECT_EQ(set_telling(context(), cloud.scene(), told), PT_ERROR_INVALID_SCENE);
    EXPECT_TRUE(told.shares.empty() || told.shares.back() < 1.0);
}

TEST_F(SetSceneTest, LeavesAllAsItWasWhereItIsStopped) {
    Cloud before(200);
    Cloud cloud(many);
    set_view(context());
    for (const bool is_kept : {false, true}) {
        if (is_kept) {
            before = cloud;
            cloud.move();
        }
        set(context(), before.scene());
        const std::vector<char> expected = film_of(context(), 2);
        pt_result result = PT_CANCELLED;
        std::size_t stopped = 0;
        for (; result == PT_CANCELLED; ++stopped) {
            Told told{.shares = {}, .most = stopped};
            result = set_telling(context(), cloud.scene(), told);
            EXPECT_EQ(told.shares.size(), stopped + (result == PT_CANCELLED ? 1 : 0)) << "it was called again";
            if (result == PT_CANCELLED) {
                EXPECT_EQ(stats().sample_count, 2U);
                EXPECT_EQ(film_of(context(), 1).size(), expected.size());
                set(context(), before.scene());
                EXPECT_EQ(film_of(context(), 2), expected) << "stopped at call " << stopped;
            }
        }
        EXPECT_EQ(result, PT_OK) << pt_last_error(context());
        EXPECT_GE(stopped, 3U);
        EXPECT_EQ(stats().sample_count, 0U);
    }
    const std::vector<char> film = film_of(context(), 2);
    const Context other = create_context();
    set_view(other.get());
    set(other.get(), cloud.scene());
    EXPECT_EQ(film_of(other.get(), 2), film);
}

} // namespace

} // namespace set_scene
