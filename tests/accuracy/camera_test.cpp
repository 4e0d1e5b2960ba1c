#include "camera_items.spv.h"
#include "tests/accuracy/direction.h"
#include "tests/accuracy/evaluation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace accuracy::camera {

namespace {

struct Item {
    glm::vec3 right;
    std::uint32_t width;
    glm::vec3 up;
    std::uint32_t height;
    glm::vec4 forward;
    std::uint32_t column, row;
    glm::vec2 place;
    float lens_radius, lens_blur; // radius / blur = focus distance / image plane distance
    glm::vec2 disc;
};

struct Result {
    glm::vec4 direction, lens_origin, lens_direction;
};

std::vector<Item> items() {
    Inputs inputs(4);
    std::vector<Item> items;
    for (std::size_t i = 0; i < random_count; ++i) {
        Item item{};
        const glm::dvec3 forward = glm::normalize(glm::dvec3(inputs.direction()));
        const glm::dvec3 right =
            glm::normalize(glm::cross(forward, glm::dvec3(inputs.direction()) + glm::dvec3(0.01, 0.02, 0.03)));
        const double tan_half_fov = inputs.log_uniform(5e-9, 1e8);
        item.width = i % 4 == 1 ? 16384 : static_cast<std::uint32_t>(inputs.log_uniform(1.0, 16384.0));
        item.height = i % 4 == 1 ? 16384 : static_cast<std::uint32_t>(inputs.log_uniform(1.0, 16384.0));
        item.right = glm::vec3(right);
        item.up = glm::vec3(glm::cross(right, forward));
        item.forward = glm::vec4(glm::vec3(0.5 * item.height / tan_half_fov * forward), 0.0F);
        item.column = i % 4 == 0 ? item.width - 1 : inputs.word() % item.width;
        item.row = i % 4 == 0 ? 0 : inputs.word() % item.height;
        item.place = {inputs.number(), inputs.number()};
        item.lens_radius = static_cast<float>(inputs.log_uniform(1e-6, 1e6));
        item.lens_blur = static_cast<float>(0.5 * item.height / tan_half_fov * inputs.log_uniform(1e-9, 1.0));
        const float angle = 6.28F * inputs.number();
        item.disc = std::sqrt(inputs.number()) * glm::vec2(std::cos(angle), std::sin(angle));
        items.push_back(item);
    }
    return items;
}

// Bounds the error of a direction. Let u = 2^-24 and W = forward + x right - y up. The products add errors of 2 u (|x|
// + |y|) <= 2.9 u |W|, and the sums add 2 u |W|. Dividing W by its length adds 3 u / 2 for the dot product, 9 u for
// sqrt and 5 u for the division.
constexpr Real bound = (2.9L + 2 + 15.5L) * half_ulp;

// Bounds the distance of the lens ray from the pinhole ray in the plane of focus, divided by the rays' length. The
// radius adds an error of 7 u: 2 u for lens_radius in the origin, 2 u for lens_blur in the direction, u for the
// direction's length, and 2 u for the position in the image.
Real lens_bound(Real radius, Real distance) {
    return 7 * half_ulp * radius / distance + bound;
}

TEST(AccuracyCamera, OfDirections) {
    Comparison direction("camera_direction", "length");
    const std::vector<Item> all = items();
    Probe probe(camera_items_spirv(), sizeof(ItemRange));
    const std::vector<Result> results = evaluate<Result>(probe, all);
    Comparison focus("ray_through_lens", "length");
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Item &item = all[i];
        const Real x = Real{0} + item.column + item.place.x - Real{0.5} * item.width;
        const Real y = Real{0} + item.row + item.place.y - Real{0.5} * item.height;
        const Direction exact = Direction(item.forward) + x * Direction(item.right) - y * Direction(item.up);
        const std::vector<float> of_item = {static_cast<float>(item.width),
                                            static_cast<float>(item.height),
                                            item.forward.x,
                                            item.forward.y,
                                            item.forward.z,
                                            static_cast<float>(x),
                                            static_cast<float>(y),
                                            item.lens_radius,
                                            item.lens_blur};
        direction.add(glm::vec3(results[i].direction), glm::normalize(exact), bound, of_item);
        const Direction sharp = Real{item.lens_radius} / Real{item.lens_blur} * exact;
        const Direction on_way = sharp - Direction(results[i].lens_origin);
        const Real distance = glm::length(on_way);
        focus.add(glm::vec3(results[i].lens_direction), on_way / distance, lens_bound(item.lens_radius, distance),
                  of_item);
    }
    direction.finish();
    focus.finish();
}

} // namespace

} // namespace accuracy::camera
