// Prints how well images agree with exact values. No value fails the test.
#include "tests/analytic/analytic_fixture.h"
#include "tests/analytic/crop.h"
#include "tests/analytic/scenes.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <vector>

namespace {

using namespace analytic;

constexpr std::uint32_t range_batch_count = 16;

class OperatingRange : public AnalyticFixture {
protected:
    void measure(double value, const cli::SceneFile &scene, const pt_camera &camera, const Crop &crop, double expected,
                 std::uint32_t samples) {
        const pt_scene library_scene = scene.scene();
        pt_render render = render_of(crop.width, crop.height, scene.render.max_path_length);
        if (pt_set_scene(context(), &library_scene) != PT_OK || pt_set_camera(context(), &camera) != PT_OK) {
            std::printf("  %8.1e refused: %s\n", value, pt_last_error(context()));
            return;
        }
        Batches batches;
        std::uint64_t rejected = 0;
        for (render.seed = 1; render.seed <= range_batch_count; ++render.seed) {
            std::vector<float> image(std::size_t{3} * crop.width * crop.height);
            ASSERT_EQ(pt_set_render(context(), &render), PT_OK) << pt_last_error(context());
            accumulate(samples);
            readback(image);
            rejected += stats().rejected_samples;
            batches.push_back({double{image[3 * (std::size_t{crop.y} * crop.width + crop.x)]}});
        }
        const Estimate found = estimate_of_pixel(batches, 0);
        const double error = found.mean / expected - 1.0;
        const double bound = batch_bound(found, {expected, 0.0}, range_batch_count) / expected;
        const bool holds = std::abs(error) <= bound && bound < 0.01 && rejected == 0;
        const char *verdict = holds ? "" : std::abs(error) <= bound ? "  TOO NOISY" : "  FAILS";
        std::printf("  %8.1e expected %-13.8g measured %-13.8g off by %8.1e, noise allows %7.1e%s%s\n", value, expected,
                    found.mean, error, bound, verdict, rejected ? ", samples rejected" : "");
    }

    void measure(double value, const cli::SceneFile &scene, std::uint32_t x, std::uint32_t y, double expected) {
        const Crop crop = crop_around(scene.render.width, scene.render.height, x, y);
        measure(value, scene, cropped(scene.camera, scene.render.height, crop.height), crop, expected, 1024);
    }

    double light_of(const cli::SceneFile &scene) {
        set_up(scene.scene(), scene.camera);
        double sum = 0.0;
        for (const std::vector<double> &image :
             render_batches(render_of(1, 1, scene.render.max_path_length), range_batch_count, 1 << 18))
            sum += image[0] / range_batch_count;
        return sum;
    }
};

void scale(cli::SceneFile &scene, double factor) {
    for (pt_sphere &sphere : scene.spheres) {
        sphere.radius *= factor;
        for (double &component : sphere.center)
            component *= factor;
    }
    for (pt_plane &plane : scene.planes)
        plane.offset *= factor;
    for (int i = 0; i < 3; ++i) {
        scene.camera.position[i] *= factor;
        scene.camera.target[i] *= factor;
    }
}

TEST_F(OperatingRange, Scale) {
    std::printf("\nunit of length\n");
    for (int exponent = -18; exponent <= 18; ++exponent) {
        cli::SceneFile scene = read_scene("01-above");
        scale(scene, std::pow(10.0, exponent));
        measure(std::pow(10.0, exponent), scene, 128, 127, 0.12151634857013521);
    }
}

struct Look {
    const char *name;
    glm::dvec3 direction;
    double motion;
};

const std::vector<Look> looks = {{"along an axis", {0, 0, -1}, 0.0},
                                 {"obliquely", glm::normalize(glm::dvec3(0.48, 0.61, -0.63)), 0.0},
                                 {"obliquely and in motion", glm::normalize(glm::dvec3(0.48, 0.61, -0.63)), 0.25}};

void store(const glm::dvec3 &from, double (&to)[3]) {
    for (int i = 0; i < 3; ++i)
        to[i] = from[i];
}

// Returns the area of the ellipse (c_x x - c_z)^2 >= (|c|^2 - 1) (x^2 + y^2 + 1), the image of a unit sphere at c = (x,
// 0, z) on the image plane at distance 1. It is pi |det M| / |det M'|^(3/2) for the conic's matrix M and its part M' in
// x, y.
double area_of_unit_sphere(double x, double z) {
    const double tangent = x * x + z * z - 1.0;
    return std::numbers::pi * tangent * tangent / std::pow(tangent * (z * z - 1.0), 1.5);
}

// Returns the area of a moving unit sphere on the image plane at distance 1, from six Gauss nodes in time.
double area_in_motion(double distance, double way) {
    constexpr std::array<std::array<double, 2>, 3> nodes{{{0.2386191860831969, 0.4679139345726910},
                                                          {0.6612093864662645, 0.3607615730481386},
                                                          {0.9324695142031521, 0.1713244923791704}}};
    double sum = 0.0;
    for (const auto &[node, weight] : nodes)
        sum += weight * area_of_unit_sphere(0.5 * way * node, distance);
    return sum;
}

TEST_F(OperatingRange, DistanceOfASphere) {
    for (const Look &look : looks) {
        std::printf("\ndistance from a sphere's surface / radius, %s\n", look.name);
        const glm::dvec3 across = glm::normalize(glm::cross(look.direction, glm::dvec3(0, 1, 0)));
        for (int exponent = look.motion > 0 ? -3 : -12; exponent <= 9; ++exponent) {
            const double gap = std::pow(10.0, exponent);
            const double way = look.motion * std::min(gap, 1.0);
            cli::SceneFile scene = read_scene("27-silhouette");
            pt_sphere sphere{{}, 1, {}, 0, 0};
            store((1 + gap) * look.direction - 0.5 * way * across, sphere.center);
            store(way * across, sphere.motion);
            scene.spheres[0] = sphere;
            store({0, 0, 0}, scene.camera.position);
            store(look.direction, scene.camera.target);
            scene.camera.vertical_fov = 2.0 * std::atan(2.0 / std::sqrt(gap * (2.0 + gap)));
            // At large distances the formula suffers from cancellation, but the area equals a disc's.
            const double still = gap * (2.0 + gap);
            const double area = way > 0.0 && gap < 1e3 ? area_in_motion(1 + gap, way) : std::numbers::pi / still;
            measure(gap, scene, scene.camera, {1, 1, 0, 0}, area * still / 16.0, 65536);
        }
    }
}

constexpr double floor_side = 0.1;
constexpr double lamp_height = 3.1;

// Returns the mean over a square around (0, 0) on a floor of albedo 0.8. The lamp of radius 1 and emission 10 is at (3,
// 2.1, 0). Two Gauss nodes for each direction give an error of 1e-7.
double floor_under_lamp() {
    double sum = 0.0;
    const double node = 0.5 * floor_side / std::sqrt(3.0);
    for (const double x : {-node, node})
        sum += 0.8 * 10 * lamp_height / std::pow(std::hypot(3 - x, node, lamp_height), 3);
    return sum / 2;
}

TEST_F(OperatingRange, DistanceOfALitFloor) {
    std::printf("\ndistance of a floor / distance of its lamp, from above\n");
    for (int exponent = 0; exponent <= 8; ++exponent) {
        const double distance = std::numbers::pi / 3.0 * std::pow(10.0, exponent);
        cli::SceneFile scene = read_scene("01-above");
        scene.spheres[0] = {{3, lamp_height - 1, 0}, 1, {0, 0, 0}, scene.spheres[0].material, 0};
        scene.camera = {sizeof(pt_camera), 0, {0, distance - 1, 0}, {0, -1, 0}, {0, 0, 1}, 0, 0, 0, 0, 0, 0};
        scene.camera.vertical_fov = 2.0 * std::atan(0.5 * floor_side / distance);
        measure(distance / std::hypot(3.0, lamp_height), scene, scene.camera, {1, 1, 0, 0}, floor_under_lamp(), 16384);
    }
}

TEST_F(OperatingRange, SizeOfALamp) {
    std::printf("\nradius / distance of a lamp\n");
    for (int exponent = -15; exponent <= 2; ++exponent) {
        cli::SceneFile scene = read_scene("05-tiny-far");
        const double radius = std::pow(10.0, exponent);
        pt_material &material = scene.materials[scene.spheres[0].material];
        const double emission = std::min(1e18, 1e6 / (radius * radius));
        std::ranges::fill(material.emission, static_cast<float>(emission));
        scene.spheres[0].radius = radius;
        measure(radius / 1000.0, scene, 128, 127,
                0.6404319556986502 * double{material.emission[0]} * radius * radius / 1e6);
    }
}

TEST_F(OperatingRange, SizeOfAFloorBall) {
    for (const double motion : {0.0, 1e-9, 1.0}) {
        std::printf("\nradius of a sphere that is the floor, motion %g\n", motion);
        for (int exponent = 4; exponent <= 17; ++exponent) {
            cli::SceneFile scene = read_scene("16-hugefloor-R1e+07");
            pt_sphere &ball = scene.spheres[0].radius > 1 ? scene.spheres[0] : scene.spheres[1];
            ball.radius = std::pow(10.0, exponent);
            ball.center[1] = -1.0 - ball.radius;
            ball.motion[0] = motion;
            // The expected value is a plane's, plus the first term in the curvature. A motion m of the ball lowers the
            // floor by m^2 / (6 R) on average.
            measure(ball.radius, scene, 128, 127, 0.12151634857013521 + 0.0640719 / ball.radius);
        }
    }
}

TEST_F(OperatingRange, DistanceOfAWorld) {
    for (const Look &look : looks) {
        std::printf("\ndistance of a lit world of size 3, %s\n", look.name);
        double expected = 0.0;
        for (int exponent = 4; exponent <= 8; ++exponent) {
            const double distance = std::pow(10.0, exponent);
            cli::SceneFile scene = read_scene("14-gloss-n40");
            const std::uint32_t white = 0, lamp = 1;
            scene.materials = {{{0.7F, 0.7F, 0.7F}, {0, 0, 0}, {0, 0, 0}, 0, 0},
                               {{0, 0, 0}, {0, 0, 0}, {20, 20, 20}, 0, 0}};
            scene.planes.clear();
            const glm::dvec3 middle = distance * look.direction;
            const glm::dvec3 away = 0.8 * look.direction;
            scene.spheres = {{{}, 1, {}, white, 0}, {{}, 0.3, {}, lamp, 0}, {{}, 0.4, {}, white, 0}};
            store(middle + away, scene.spheres[0].center);
            store(middle - glm::dvec3(0.9, -1, 0.3), scene.spheres[1].center);
            store(middle - glm::dvec3(0.5, -0.6, 0.1), scene.spheres[2].center);
            store(glm::dvec3(look.motion, 0, look.motion), scene.spheres[2].motion);
            store({0, 0, 0}, scene.camera.position);
            store(look.direction, scene.camera.target);
            scene.camera.vertical_fov = 2.0 * std::atan(1.7 / distance);
            scene.render.max_path_length = 4;
            if (exponent == 4) // Perspective then changes the light by less than a thousandth.
                expected = light_of(scene);
            measure(distance, scene, scene.camera, {1, 1, 0, 0}, expected, 65536);
        }
    }
}

// From n = 3000 on, the albedo of the lobe equals the cosine.
TEST_F(OperatingRange, GlossinessUnderADome) {
    std::printf("\nglossiness under a uniform dome\n");
    for (const double glossiness : {1e-30, 1e-12, 1e-7, 3e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10}) {
        cli::SceneFile scene = read_scene("12-phong-furnace-n3000");
        scene.materials[scene.planes[0].material].glossiness = static_cast<float>(glossiness);
        measure(glossiness, scene, 128, 80, glossiness < 1.0 ? 0.5639230931531707 : 0.12784618630634145);
    }
}

TEST_F(OperatingRange, GlossinessUnderALamp) {
    std::printf("\nglossiness under a lamp that fills the lobe\n");
    for (const double glossiness : {3e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9}) {
        cli::SceneFile scene = read_scene("13-mirror-n1e6");
        scene.materials[scene.planes[0].material].glossiness = static_cast<float>(glossiness);
        measure(glossiness, scene, 128, 100, 1.5356352480155948);
    }
}

TEST_F(OperatingRange, Emission) {
    std::printf("\nemission of the only lamp\n");
    for (int exponent = -45; exponent <= 18; exponent += 3) {
        cli::SceneFile scene = read_scene("01-above");
        std::ranges::fill(scene.materials[scene.spheres[0].material].emission,
                          static_cast<float>(std::pow(10.0, exponent)));
        const double emission = double{scene.materials[scene.spheres[0].material].emission[0]};
        measure(std::pow(10.0, exponent), scene, 128, 127, 0.012151634857013521 * emission);
    }
}

TEST_F(OperatingRange, RatioOfLamps) {
    std::printf("\na hidden lamp's emission / the seen one's\n");
    for (int exponent = 0; exponent <= 18; ++exponent) {
        cli::SceneFile scene = read_scene("20-ratio1e8");
        std::ranges::fill(scene.materials[scene.spheres[0].material].emission,
                          static_cast<float>(std::pow(10.0, exponent)));
        measure(std::pow(10.0, exponent), scene, 128, 82, 0.002876759225824044);
    }
}

} // namespace
