#include "tests/support/context_calls.h"
#include "tests/support/light_in_double.h"

#include <pt/film.h>
#include <pt/stats.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

namespace capsules {

namespace {

using namespace light_in_double;

constexpr std::size_t pixel_count = std::size_t{picture.x} * picture.y;

glm::dvec3 vector_of(const double (&components)[3]) {
    return {components[0], components[1], components[2]};
}

struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t index = 0;
};

Nearest nearest_of(const std::vector<Given::Capsule> &capsules, const glm::dvec3 &point) {
    Nearest nearest;
    for (std::size_t i = 0; i < capsules.size(); ++i) {
        const glm::dvec3 first = vector_of(capsules[i].center);
        const glm::dvec3 way = vector_of(capsules[i].end) - first;
        const double square = glm::dot(way, way);
        const double share = square > 0.0 ? std::clamp(glm::dot(point - first, way) / square, 0.0, 1.0) : 0.0;
        const double distance = glm::length(point - first - share * way) - capsules[i].radius;
        if (distance < nearest.distance)
            nearest = {distance, i};
    }
    return nearest;
}

// One `direction` is 1 of depth.
struct CameraRay {
    glm::dvec3 origin, direction;

    CameraRay(const pt_camera &camera, std::uint32_t pixel) : origin(vector_of(camera.position)) {
        const glm::dvec3 forward = glm::normalize(vector_of(camera.target) - origin);
        const glm::dvec3 right = glm::normalize(glm::cross(forward, vector_of(camera.up)));
        const glm::dvec3 up = glm::cross(right, forward);
        const bool is_parallel = camera.projection == PT_PROJECTION_ORTHOGRAPHIC;
        const double size =
            (is_parallel ? camera.vertical_extent : 2.0 * std::tan(0.5 * camera.vertical_fov)) / picture.y;
        const glm::dvec3 aside = size * ((pixel % picture.x + 0.5 - 0.5 * picture.x) * right -
                                         (pixel / picture.x + 0.5 - 0.5 * picture.y) * up);
        origin += is_parallel ? aside : glm::dvec3(0.0);
        direction = is_parallel ? forward : forward + aside;
    }
};

class Capsules : public LightInDouble {
protected:
    std::size_t wrong_pixels(const Given &seen, const Given &truth) {
        set_picture(context(), seen.scene(), seen.camera, picture_of(PT_SAMPLER_SOBOL));
        const std::vector<float> depths = values_of(context(), pixel_count, PT_QUANTITY_DEPTH);
        std::vector<std::uint32_t> objects(pixel_count);
        pt_image target = image_target({}, PT_QUANTITY_OBJECT);
        target.format = PT_FORMAT_R32UI;
        target.data = objects.data();
        target.size_bytes = objects.size() * sizeof objects[0];
        EXPECT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
        std::size_t met = 0;
        std::size_t wrong = 0;
        for (std::uint32_t i = 0; i < objects.size(); ++i) {
            const CameraRay ray(truth.camera, i);
            double depth = 0.0;
            Nearest nearest;
            for (int step = 0; step < 20'000 && depth < 1000.0; ++step) {
                nearest = nearest_of(truth.capsules, ray.origin + depth * ray.direction);
                if (nearest.distance < 1e-9)
                    break;
                depth += nearest.distance / glm::length(ray.direction);
            }
            const bool meets = nearest.distance < 1e-9;
            met += meets ? 1 : 0;
            // The error of float32 is 8 2^-24 at a distance of 8, and 2^-23 of the huge radius. At grazing angles the
            // error becomes the square root of this.
            const bool is_near = std::abs(depths[3 * i] - depth) < 2e-4 * depth;
            const bool is_object = objects[i] == seen.spheres.size() + nearest.index;
            wrong += meets != std::isfinite(depths[3 * i]) || (meets && !(is_near && is_object)) ? 1 : 0;
        }
        EXPECT_GT(met, 100U);
        return wrong;
    }
};

// Negative control: radii that are larger by 3%.
TEST_F(Capsules, AreMetWhereTheirDistanceIsZero) {
    Given given = scene_of_rods(11, 40);
    given.planes.clear();
    given.spheres.resize(1);
    given.capsules.push_back({{0, 0, 0}, {0.28, 0, 0.96}, 0.3, 0});
    given.capsules.push_back({{0, 0, 0}, {0.28, 0, 0.96}, 0.15, 0});
    given.capsules.push_back({{-1, 1, 0}, {-1 + 1e-9, 1, 0}, 0.25, 0});
    given.capsules.push_back({{1, 1, 0}, {1, 1, 0}, 0.25, 0});
    given.capsules.push_back({{-900, -1.5, -3}, {900, -1.4, -3}, 0.2, 0});
    given.capsules.push_back({{0, -1030, -20}, {90, -1030, -20}, 1000, 0});
    EXPECT_EQ(wrong_pixels(given, given), 0U);
    Given thicker = given;
    for (Given::Capsule &rod : thicker.capsules)
        rod.radius *= 1.03;
    EXPECT_GT(wrong_pixels(thicker, given), 50U);
    const std::vector<Given::Capsule> others = scene_of_rods(12, 400).capsules;
    given.capsules.insert(given.capsules.end(), others.begin(), others.end());
    EXPECT_EQ(wrong_pixels(given, given), 0U);
    EXPECT_TRUE(stats().features & PT_FEATURE_TREE);
}

TEST_F(Capsules, AreSeenInParallel) {
    Given given;
    given.planes.clear();
    given.camera = camera_at({0, 0, 10}, {0, 0, 0}, 0.0);
    given.camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
    given.camera.vertical_extent = 2.0;
    for (const double first : {-1.0, 1.0}) {
        given.capsules = {{{0, 0, first}, {0, 0, -first}, 0.75, 1}};
        EXPECT_EQ(wrong_pixels(given, given), 0U) << first;
    }
    given.capsules = {{{-1, 0.25, 0}, {1, -0.25, 0}, 0.5, 1}};
    given.camera.vertical_extent = 4.0;
    pt_render render = picture_of(PT_SAMPLER_SOBOL);
    render.flags = PT_RENDER_COVERAGE;
    render_image(context(), given.scene(), given.camera, render, 64);
    const auto mean = [&](std::uint32_t quantity) {
        const std::vector<float> values = values_of(context(), pixel_count, quantity);
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < values.size(); i += 3)
            sum += glm::dvec3(values[i], values[i + 1], values[i + 2]);
        return sum / static_cast<double>(pixel_count);
    };
    const double area = 2.0 * 0.5 * std::hypot(2.0, 0.5) + std::numbers::pi * 0.25;
    const double facing = 2.0 / 3.0 * std::numbers::pi * 0.25 + std::numbers::pi / 4.0 * std::hypot(2.0, 0.5);
    const glm::dvec3 normal = mean(PT_QUANTITY_NORMAL);
    EXPECT_NEAR(mean(PT_QUANTITY_COVERAGE).x, area / 24.0, 2e-3);
    EXPECT_NEAR(mean(PT_QUANTITY_ALBEDO).x, 0.5 * area / 24.0, 2e-3);
    EXPECT_NEAR(normal.z, facing / 24.0, 1e-3);
    EXPECT_NEAR(glm::length(glm::dvec2(normal)), 0.0, 1e-3);
}

} // namespace

} // namespace capsules
