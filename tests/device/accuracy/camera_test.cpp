// camera_direction against long double.
#include "camera_items.spv.h"
#include "tests/device/accuracy/direction.h"
#include "tests/device/accuracy/evaluation.h"

#include <gtest/gtest.h>

#include <algorithm>

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
};

// Fields of view from 1e-8 to nearly pi, images of one pixel to 16384 wide; a quarter of the pixels in a corner.
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
        items.push_back(item);
    }
    return items;
}

// Absolute, as the components of a unit vector pass through 0. With W = forward + x right - y up, whose parts are
// perpendicular and so no longer than W, and u = 2^-24: x and y err by u, and so do their products: 2 u (|x| + |y|) <=
// 2.9 u |W|. The two sums err by u |W| each. normalize is W / length(W): the dot product 3 u, half of it in the root,
// sqrt 9 u and the division 5 u.
constexpr Real bound = (2.9L + 2 + 15.5L) * half_ulp;

TEST(AccuracyCamera, OfDirections) {
    Comparison direction("camera_direction", "length");
    const std::vector<Item> all = items();
    Probe probe(camera_items_spirv(), sizeof(ItemRange));
    const std::vector<glm::vec4> results = evaluate<glm::vec4>(probe, all);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Item &item = all[i];
        const Real x = Real{0} + item.column + item.place.x - Real{0.5} * item.width;
        const Real y = Real{0} + item.row + item.place.y - Real{0.5} * item.height;
        const Direction exact = Direction(item.forward) + x * Direction(item.right) - y * Direction(item.up);
        direction.add(glm::vec3(results[i]), glm::normalize(exact), bound,
                      {static_cast<float>(item.width), static_cast<float>(item.height), item.forward.x, item.forward.y,
                       item.forward.z, static_cast<float>(x), static_cast<float>(y)});
    }
    direction.finish();
}

} // namespace

} // namespace accuracy::camera
