#include "lib/film/error_estimate.h"
#include "lib/render/missed_lamps.h"
#include "lib/scene/camera.h"
#include "lib/scene/checked_scene.h"
#include "lib/view/small_lamps.h"
#include "tests/support/checked_scene_of.h"
#include "tests/support/scene_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace small_lamps {

namespace {

constexpr std::uint32_t dark = 0;
constexpr std::uint32_t lamp = 1;
constexpr std::uint32_t hidden = 2;

// At depth 100 a pixel of 200 rows has side 1.
constexpr pt::Camera camera{.position = {1.0, 2.0, 3.0},
                            .right = {1, 0, 0},
                            .up = {0, 1, 0},
                            .forward = {0, 0, -1},
                            .view_size = 1.0,
                            .shutter_open = 0.0,
                            .shutter_close = 0.0};

pt::Camera parallel_camera() {
    pt::Camera parallel = camera;
    parallel.view_size = 200.0;
    parallel.projection = PT_PROJECTION_ORTHOGRAPHIC;
    return parallel;
}

pt_sphere sphere_at(double x, double y, double depth, double radius, std::uint32_t material) {
    return {{1.0 + x, 2.0 + y, 3.0 - depth}, radius, {}, material, 0};
}

std::vector<pt::LampPiece> pieces_of(const std::vector<pt_sphere> &spheres, const std::vector<pt_plane> &planes = {},
                                     const pt::Camera &seen_by = camera, bool has_tree = false,
                                     std::span<const pt_sphere_array> arrays = {}) {
    const pt_material materials[] = {{{0.5F, 0.5F, 0.5F}, {}, {}, 0.0F, 0},
                                     {{}, {}, {1.0F, 2.0F, 40.0F}, 0.0F, 0},
                                     {{0.5F, 0.5F, 0.5F}, {}, {}, 0.0F, PT_MATERIAL_HIDDEN_FROM_CAMERA}};
    const pt_scene scene = scene_of(materials, spheres, planes, arrays);
    const pt::PreparedScene prepared = prepared_scene_of(checked_scene_of(scene), has_tree ? 1 : 1000);
    EXPECT_EQ(prepared.tree != nullptr, has_tree);
    return pt::small_lamps_in_view(prepared, *pt::projection_of(seen_by, 400, 200), 0, 200);
}

double share_of(const std::vector<pt::LampPiece> &pieces, std::uint32_t x, std::uint32_t y) {
    const auto piece = std::ranges::find_if(pieces, [&](const auto &other) { return other.x == x && other.y == y; });
    return piece == pieces.end() ? 0.0 : piece->share;
}

constexpr double radius = 0.25;
constexpr double size = std::numbers::pi * radius * radius;
constexpr double thin = 2e-4; // 256 lines cover the lamp's disc. Each has an error of at most the square of its height.

TEST(SmallLamps, AreSpreadOverPixels) {
    for (const pt::Camera &seen_by : {camera, parallel_camera()})
        for (const bool has_tree : {false, true}) {
            const auto middle = pieces_of({sphere_at(0.5, 0.5, 100, radius, lamp)}, {}, seen_by, has_tree);
            ASSERT_EQ(middle.size(), 1U);
            EXPECT_NEAR(share_of(middle, 200, 99), size, thin);
            EXPECT_DOUBLE_EQ(middle[0].lamp_share, size);
            EXPECT_EQ(middle[0].emission, glm::dvec3(1, 2, 40));
            const auto corner = pieces_of({sphere_at(0, 0, 100, radius, lamp)}, {}, seen_by, has_tree);
            ASSERT_EQ(corner.size(), 4U);
            for (const std::uint32_t x : {199U, 200U})
                for (const std::uint32_t y : {99U, 100U})
                    EXPECT_NEAR(share_of(corner, x, y), 0.25 * size, thin);
        }
    const double segment = radius * radius * (std::numbers::pi / 3.0 - std::sqrt(3.0) / 4.0);
    const auto aside = pieces_of({sphere_at(0.5 * radius, 0.5, 100, radius, lamp)});
    EXPECT_NEAR(share_of(aside, 199, 99), segment, thin);
    EXPECT_NEAR(share_of(aside, 200, 99), size - segment, thin);
    const auto at_the_edge = pieces_of({sphere_at(200, 99.5, 100, radius, lamp)});
    ASSERT_EQ(at_the_edge.size(), 1U);
    EXPECT_NEAR(share_of(at_the_edge, 399, 0), 0.5 * size, thin);
}

struct Spread {
    double seen = 0.0;
    double largest = 0.0;

    explicit Spread(const std::vector<pt::LampPiece> &pieces) {
        for (const pt::LampPiece &piece : pieces) {
            EXPECT_TRUE(piece.is_spread);
            seen += piece.pixels * piece.share;
            largest = std::max(largest, piece.share);
        }
    }
};

// The lens's disc has the radius 30 |100 / 75 - 1| = 10 pixels, or an area of 314 pixels.
TEST(SmallLamps, AreSpreadByALens) {
    const std::vector<pt_sphere> lamps{sphere_at(0.5, 0.5, 100, radius, lamp)};
    pt::Camera lens = camera;
    lens.lens_radius = 30.0;
    lens.focus = 100.0;
    const auto sharp = pieces_of(lamps, {}, lens);
    ASSERT_EQ(sharp.size(), 1U);
    EXPECT_EQ(sharp[0].share, pieces_of(lamps)[0].share);
    EXPECT_EQ(sharp[0].pixels, 1.0);
    lens.focus = 75.0;
    const double share = size / (std::numbers::pi * (100.0 + radius * radius));
    const auto blurred = pieces_of(lamps, {}, lens);
    EXPECT_DOUBLE_EQ(blurred.at(0).lamp_share, share);
    EXPECT_NEAR(Spread(blurred).seen, size, thin * size);
    EXPECT_NEAR(Spread(blurred).largest, share, share / 38.0) << "to a line, of which there are 38 to a square";
}

// The pixel sees the lamp's area while the lamp moves by one pixel.
TEST(SmallLamps, AreSpreadByTheirMotion) {
    pt::Camera open = camera;
    open.shutter_close = 1.0;
    for (const double way : {20.0, 300.0}) { // the motion is sampled at every pixel, or more coarsely
        pt_sphere moving = sphere_at(-0.5 * way, 0.5, 100, radius, lamp);
        moving.motion[0] = way;
        const Spread found(pieces_of({moving}, {}, open));
        EXPECT_NEAR(found.seen, size, 0.01 * size) << way; // A moving lamp has fewer lines, so the tolerance is larger.
        EXPECT_NEAR(found.largest, size / way, 0.01 * size / way) << way;
    }
}

TEST(SmallLamps, AreThoseThatTheCameraSees) {
    const pt_sphere seen = sphere_at(10, 10, 100, radius, lamp);
    const auto count_of = [](const std::vector<pt_sphere> &spheres, const std::vector<pt_plane> &planes = {}) {
        std::vector<std::size_t> counts;
        for (const pt::Camera &seen_by : {camera, parallel_camera()})
            for (const bool has_tree : {false, true})
                counts.push_back(pieces_of(spheres, planes, seen_by, has_tree).size());
        EXPECT_EQ(std::ranges::count(counts, counts[0]), 4);
        return counts[0];
    };
    const std::size_t alone = count_of({seen});
    EXPECT_EQ(alone, 4U);
    EXPECT_EQ(count_of({sphere_at(10, 10, -100, radius, lamp)}), 0U) << "behind the camera";
    EXPECT_EQ(count_of({sphere_at(201, 10, 100, radius, lamp)}), 0U) << "beside the view";
    EXPECT_EQ(count_of({sphere_at(10, 10, 100, 0.5, lamp)}), 0U) << "large";
    EXPECT_EQ(count_of({seen, sphere_at(10, 10, 99, 0.4, dark)}), 0U) << "behind a ball";
    EXPECT_EQ(count_of({seen, sphere_at(10, 10, 101, 0.4, dark)}), alone) << "before a ball";
    EXPECT_EQ(count_of({seen, sphere_at(10.5, 10, 99, 0.4, dark)}), alone) << "beside a ball";
    EXPECT_EQ(count_of({seen, sphere_at(10, 10, 99, 0.4, hidden)}), alone) << "behind one that is not seen";
    EXPECT_EQ(count_of({seen, sphere_at(0, 0, 0, 50, dark)}), 0U) << "beyond a ball about the camera";
    EXPECT_EQ(count_of({seen, sphere_at(0, 0, 0, 500, dark)}), alone) << "in a ball about both";
    const pt_plane wall{{0.0, 0.0, 1.0}, 47.0, dark, 0};
    EXPECT_EQ(count_of({seen}, {wall}), 0U) << "behind a plane";
}

// A veil transmits 1 - opacity of the light. Veils lie around the lamp or before it, and lamps are small or large.
TEST(SmallLamps, ShineThroughVeils) {
    const double center[] = {1.0, 2.0, -97.0, 1.0, 2.0, -60.0, 31.0, 2.0, -60.0};
    const double radii[] = {10.0, 5.0, 5.0};
    const float opacities[] = {0.2F, 0.6F, 1.0F}; // 0.2 and 0.6 are 51 and 153 of 255.
    std::vector<pt_sphere_array> veils{
        array_of(3, {center, sizeof(double[3]), PT_TYPE_FLOAT64}, {radii, sizeof(double), PT_TYPE_FLOAT64})};
    veils[0].opacity = {opacities, sizeof(float), PT_TYPE_FLOAT32};
    const auto small = pieces_of({sphere_at(0.5, 0.5, 100, radius, lamp)}, {}, camera, true, veils);
    ASSERT_EQ(small.size(), 1U);
    EXPECT_NEAR(small[0].share, 0.8 * 0.4 * size, thin);
    EXPECT_NEAR(small[0].lamp_share, 0.8 * 0.4 * size, 1e-7);
    const auto large = pieces_of({sphere_at(0.5, 0.5, 100, 2.0, lamp)}, {}, camera, true, veils);
    EXPECT_NEAR(share_of(large, 200, 99), 0.8 * 0.4, 0.01);
    EXPECT_TRUE(pieces_of({sphere_at(50.5, 0.5, 100, radius, lamp)}, {}, camera, true, veils).empty()) << "opaque";
}

TEST(SmallLamps, AreSeenFromWithinACapsule) {
    const pt_sphere first = sphere_at(0, 0, -10, 50, dark);
    const pt_sphere last = sphere_at(0, 0, 120, 50, dark);
    std::vector<pt_sphere_array> capsule{
        array_of(1, {first.center, 0, PT_TYPE_FLOAT64}, {&first.radius, 0, PT_TYPE_FLOAT64})};
    capsule[0].end = {last.center, 0, PT_TYPE_FLOAT64};
    for (const bool has_tree : {false, true})
        EXPECT_EQ(pieces_of({sphere_at(0.5, 0.5, 100, radius, lamp)}, {}, camera, has_tree, capsule).size(), 1U);
    EXPECT_TRUE(pieces_of({sphere_at(0.5, 0.5, 100, radius, lamp), first}).empty());
}

// If a sample hits the lamp with probability p, the variance of its light E is E^2 p (1 - p).
TEST(SmallLamps, AddWhatSamplesShouldHaveMet) {
    const std::vector<pt::LampPiece> pieces{{3, 4, 0.125, 0.25, glm::dvec3(8, 0, 16)},
                                            {5, 6, 0.25, 0.5, glm::dvec3(4)}};
    const auto with = [&](std::uint64_t first, std::uint64_t second) {
        return pt::unmet_squares(pieces, 0.01, true, [=](const auto &piece) { return piece.x == 3 ? first : second; });
    };
    const double variance = 0.125 * 0.875;
    const pt::UnmetSquares found = with(16, 16);
    EXPECT_DOUBLE_EQ(found.square.sum, variance * (64.0 + 256.0) / 16.0);
    EXPECT_DOUBLE_EQ(found.square.hits(), 16.0 * 0.125);
    EXPECT_DOUBLE_EQ(found.relative_square.sum, variance * (64.0 / 1.01 + 256.0 / 4.01) / 16.0);
    EXPECT_EQ(with(32, 16).square.sum, 0.0);
    EXPECT_DOUBLE_EQ(with(32, 8).square.sum, 3.0 * 16.0 * 0.25 * 0.75 / 8.0);
}

// Light 10 is negligible: .01^2 / (.01^2 + .01) < .01.
TEST(SmallLamps, CountAgainstATargetIfTheirLackShows) {
    for (const bool is_random : {false, true})
        for (const bool is_spread : {false, true})
            for (const float light : {10.0F, 11.0F}) {
                const pt::LampPiece piece{0, 0, 1e-3, 2e-3, glm::dvec3(0, 0, light), 1.0, is_spread};
                EXPECT_EQ(pt::samples_to_hit(piece, 0.01, is_random), light < 11.0F            ? 0U
                                                                      : is_random || is_spread ? 4000U
                                                                                               : 1500U);
            }
}

// 12 or 2 hits are expected. The error of the samples is less than the lamps' error, up to twice as large, or larger.
TEST(SmallLamps, LeaveTheErrorUncertainIfTheyAreHardlyHit) {
    for (const double hits : {12.0, 2.0})
        for (const double shown : {0.1, 5.0, 12.0}) {
            pt::ErrorEstimate error{{shown, shown, shown}, {shown, shown, shown}, 0};
            const pt::ExpectedSquares squares{12.0, 144.0 / hits};
            pt::take_in_unmet_lamps(error, {squares, squares}, 3.0);
            const double root = 2.0 * (1.0 + pt::share_added(hits));
            const bool is_uncertain = shown < 2.0 * root && hits < 10.0;
            const double bound = root * pt::spread_of_pixels(hits) * (is_uncertain ? 2.0 : 1.0);
            EXPECT_DOUBLE_EQ(error.relative_rmse.estimate, std::hypot(shown, root));
            EXPECT_DOUBLE_EQ(error.rmse.high, std::hypot(shown, bound));
            EXPECT_EQ(error.uncertain, is_uncertain ? unsigned{PT_UNCERTAIN_UNMET} : 0U);
        }
}

// Simulates the variance of the number of points in a disc of a few cells. Each cell has one random point.
TEST(SmallLamps, PointsOneToACellMeetADiscAsOftenAsStated) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    for (const double area : {1.0, 2.0, 4.0, 7.0}) {
        const double square_of_radius = area / std::numbers::pi;
        double sum = 0.0;
        constexpr int trials = 20'000;
        for (int i = 0; i < trials; ++i) {
            const double left = number(random);
            const double top = number(random);
            double met = 0.0;
            for (int cell = 0; cell < 36; ++cell) {
                const double x = left + cell % 6 - 3.0 + number(random);
                const double y = top + cell / 6 - 3.0 + number(random);
                met += x * x + y * y < square_of_radius ? 1.0 : 0.0;
            }
            sum += (met - area) * (met - area);
        }
        const std::vector<pt::LampPiece> pieces{{0, 0, area / 64.0, area / 64.0 / 8.0, glm::dvec3(64.0, 0.0, 0.0)}};
        EXPECT_NEAR(pt::unmet_squares(pieces, 0.01, false, [](const auto &) { return 64; }).square.sum, sum / trials,
                    0.15 * sum / trials)
            << area;
    }
}

double smallest_share(const std::vector<pt::Sphere> &spheres) {
    pt::Scene scene;
    scene.materials = {{glm::vec3(0), glm::vec3(0), glm::vec3(0), 0.0F},
                       {glm::vec3(0), glm::vec3(0), glm::vec3(0, 0, 5), 0.0F}};
    scene.spheres = spheres;
    return pt::smallest_lamp_share(pt::lamps_of(pt::PreparedScene(scene), camera));
}

pt::Sphere ball_at(double distance, double radius, std::uint32_t material) {
    return {camera.position + glm::dvec3(0, distance, 0), radius, glm::dvec3(0), material};
}

TEST(LampShare, IsThatOfTheSmallestLampThatMatters) {
    EXPECT_DOUBLE_EQ(smallest_share({ball_at(2, 1, lamp)}), 0.5 * (1.0 - std::sqrt(3.0) / 2.0));
    EXPECT_NEAR(smallest_share({ball_at(1e8, 1, lamp)}), 0.25e-16, 1e-30);
    EXPECT_EQ(smallest_share({ball_at(9, 1, dark), ball_at(1, 50, lamp)}), 1.0) << "no lamp to miss";
    // A lamp of 1/400 of the size has less than a hundredth of the light.
    EXPECT_EQ(smallest_share({ball_at(2, 1, lamp), ball_at(9, 1, dark), ball_at(4, 1, lamp), ball_at(1, 50, lamp),
                              ball_at(80, 1, lamp)}),
              smallest_share({ball_at(4, 1, lamp)}));
}

} // namespace

} // namespace small_lamps
