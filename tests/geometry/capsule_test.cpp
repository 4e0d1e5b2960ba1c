#include "tests/support/light_in_double.h"

#include <pt/film.h>
#include <pt/stats.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace capsules {

namespace {

using namespace light_in_double;

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

glm::dvec3 ray_of(const pt_camera &camera, std::uint32_t pixel) {
    const glm::dvec3 forward = glm::normalize(vector_of(camera.target) - vector_of(camera.position));
    const glm::dvec3 right = glm::normalize(glm::cross(forward, vector_of(camera.up)));
    const glm::dvec3 up = glm::cross(right, forward);
    const double size = 2.0 * std::tan(0.5 * camera.vertical_fov) / picture.y;
    return forward + size * ((pixel % picture.x + 0.5 - 0.5 * picture.x) * right -
                             (pixel / picture.x + 0.5 - 0.5 * picture.y) * up);
}

class Capsules : public LightInDouble {
protected:
    std::vector<float> read(std::uint32_t quantity) {
        std::vector<float> values(std::size_t{3} * picture.x * picture.y);
        const pt_image target = image_target(values, quantity);
        EXPECT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
        return values;
    }

    std::vector<float> first_hits(const Given &given, std::uint32_t quantity) {
        const pt_scene scene = given.scene();
        const pt_render render = picture_of(PT_SAMPLER_SOBOL);
        EXPECT_EQ(pt_set_scene(context(), &scene), PT_OK) << pt_last_error(context());
        EXPECT_EQ(pt_set_camera(context(), &given.camera), PT_OK) << pt_last_error(context());
        EXPECT_EQ(pt_set_render(context(), &render), PT_OK) << pt_last_error(context());
        return read(quantity);
    }

    std::size_t wrong_pixels(const Given &seen, const Given &truth) {
        const std::vector<float> depths = first_hits(seen, PT_QUANTITY_DEPTH);
        std::vector<std::uint32_t> objects(std::size_t{picture.x} * picture.y);
        pt_image target = image_target({}, PT_QUANTITY_OBJECT);
        target.format = PT_FORMAT_R32UI;
        target.data = objects.data();
        target.size_bytes = objects.size() * sizeof objects[0];
        EXPECT_EQ(pt_readback(context(), &target), PT_OK) << pt_last_error(context());
        const glm::dvec3 position = vector_of(truth.camera.position);
        std::size_t met = 0;
        std::size_t wrong = 0;
        for (std::uint32_t i = 0; i < objects.size(); ++i) {
            const glm::dvec3 ray = ray_of(truth.camera, i);
            double depth = 0.0;
            Nearest nearest;
            for (int step = 0; step < 20'000 && depth < 1000.0; ++step) {
                nearest = nearest_of(truth.capsules, position + depth * ray);
                if (nearest.distance < 1e-9)
                    break;
                depth += nearest.distance / glm::length(ray);
            }
            const bool meets = nearest.distance < 1e-9;
            met += meets ? 1 : 0;
            // The error of float32 is 8 2^-24 at a distance of 8, and 2^-23 of the huge radius. At grazing angles the
            // error becomes the square root of this.
            const bool is_near = std::abs(depths[3 * i] - depth) < 2e-4 * depth;
            const bool is_object = objects[i] == seen.spheres.size() + nearest.index;
            wrong += meets != std::isfinite(depths[3 * i]) || (meets && !(is_near && is_object)) ? 1 : 0;
        }
        EXPECT_GT(met, 170U);
        return wrong;
    }
};

// Negative control: radii that are larger by 3%.
TEST_F(Capsules, AreMetWhereTheirDistanceIsZero) {
    Given given = random_scene(11, 40, 0, 8.0);
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
    const std::vector<Given::Capsule> others = random_scene(12, 400, 0, 8.0).capsules;
    given.capsules.insert(given.capsules.end(), others.begin(), others.end());
    EXPECT_EQ(wrong_pixels(given, given), 0U);
    EXPECT_TRUE(stats().features & PT_FEATURE_TREE);
}

TEST_F(Capsules, AreSeenInParallel) {
    constexpr double radius = 0.75;
    Given given;
    given.planes.clear();
    for (const double first : {-1.0, 1.0}) {
        given.camera = camera_at({0, 0, 10}, {0, 0, 0}, 0.0);
        given.camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
        given.camera.vertical_extent = 2.0;
        given.capsules = {{{0, 0, first}, {0, 0, -first}, radius, 1}};
        const std::vector<float> depths = first_hits(given, PT_QUANTITY_DEPTH);
        for (std::uint32_t i = 0; i < picture.x * picture.y; ++i) {
            const double x = 0.125 * (i % picture.x + 0.5 - 0.5 * picture.x);
            const double y = 0.125 * (i / picture.x + 0.5 - 0.5 * picture.y);
            const double rest = radius * radius - x * x - y * y;
            ASSERT_EQ(std::isfinite(depths[3 * i]), rest > 0.0) << i;
            if (rest > 0.0) {
                EXPECT_NEAR(depths[3 * i], 9.0 - std::sqrt(rest), 1e-5) << i;
            }
        }
    }
    given.capsules = {{{-1, 0.25, 0}, {1, -0.25, 0}, 0.5, 1}};
    given.camera.vertical_extent = 4.0;
    pt_render render = picture_of(PT_SAMPLER_SOBOL);
    render.flags = PT_RENDER_COVERAGE;
    render_image(context(), given.scene(), given.camera, render, 64);
    double covered = 0.0;
    for (const float share : read(PT_QUANTITY_COVERAGE))
        covered += share / (3.0 * picture.x * picture.y);
    const double area = 2.0 * 0.5 * std::hypot(2.0, 0.5) + std::numbers::pi * 0.25;
    EXPECT_NEAR(covered, area / 24.0, 2e-3);
    const double facing = 2.0 / 3.0 * std::numbers::pi * 0.25 + std::numbers::pi / 4.0 * std::hypot(2.0, 0.5);
    glm::dvec3 normal(0.0);
    double albedo = 0.0;
    const std::vector<float> normals = read(PT_QUANTITY_NORMAL);
    const std::vector<float> albedos = read(PT_QUANTITY_ALBEDO);
    for (std::size_t i = 0; i < normals.size(); i += 3) {
        normal += glm::dvec3(normals[i], normals[i + 1], normals[i + 2]);
        albedo += albedos[i];
    }
    const double pixels = picture.x * picture.y;
    EXPECT_NEAR(normal.z / pixels, facing / 24.0, 1e-3);
    EXPECT_NEAR(glm::length(glm::dvec2(normal)) / pixels, 0.0, 1e-3);
    EXPECT_NEAR(albedo / pixels, 0.5 * area / 24.0, 2e-3);
}

TEST_F(Capsules, AreRefusedWithTheReason) {
    Given given = random_scene(1, 6, 3, 8.0);
    const auto refusal = [&](pt_sphere_array &array) {
        pt_scene scene = given.scene();
        scene.sphere_arrays = &array;
        EXPECT_EQ(pt_set_scene(context(), &scene), PT_ERROR_INVALID_SCENE);
        return std::string(pt_last_error(context()));
    };
    const auto expect_end = [](const std::string &message, const std::string &end) {
        EXPECT_NE(message.find(end), std::string::npos) << message;
    };
    given.capsules[1].material = 2;
    pt_sphere_array array = given.array();
    expect_end(refusal(array), "sphere_arrays[0].material[1] = 2: must be a material without emission");
    given.capsules[1].material = 0;
    given.capsules[2].end[1] = std::numeric_limits<double>::infinity();
    array = given.array();
    const std::string infinite = refusal(array);
    expect_end(infinite, "sphere_arrays[0].end[2] = (");
    expect_end(infinite, "): must be finite");
    given.capsules[2].end[1] = 0.0;
    array = given.array();
    array.motion = array.center;
    expect_end(refusal(array), "must be NULL with end.data, because capsules do not move");
    array = given.array();
    array.end.type = PT_TYPE_UINT32;
    expect_end(refusal(array), "end.type = 3: must be PT_TYPE_FLOAT32 (1) or PT_TYPE_FLOAT64 (2)");
}

} // namespace

} // namespace capsules
