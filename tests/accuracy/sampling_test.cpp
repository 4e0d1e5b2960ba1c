#include "sampling_items.spv.h"
#include "tests/accuracy/direction.h"
#include "tests/accuracy/evaluation.h"

#include <gtest/gtest.h>

namespace accuracy::sampling {

namespace {

struct Item {
    glm::vec3 axis;
    float height;
    glm::vec2 numbers;
    float density, other_density;
};

struct Result {
    glm::vec4 about, cosine, hemisphere, weight;
};

std::vector<Item> items() {
    Inputs inputs(1);
    std::vector<Item> items;
    // Caps have heights 1 - cos(angle) from 5e-15 (an angle of 1e-7) to 2 (the whole sphere). The densities are so far
    // apart that some squares or ratios overflow. All are within 2^+-126, where Vulkan bounds the error of division.
    for (std::size_t i = 0; i < random_count; ++i)
        items.push_back({inputs.direction(), static_cast<float>(inputs.log_uniform(5e-15, 2.0)),
                         glm::vec2(inputs.number(), inputs.number()),
                         static_cast<float>(inputs.log_uniform(1e-37, 8e37)),
                         static_cast<float>(inputs.log_uniform(1e-37, 8e37))});
    for (const float x : {0.0F, 0.25F, 0.5F, 1.0F - 0x1p-24F})
        for (const float y : {0.0F, 0.5F - 0x1p-24F, 0.5F, 1.0F - 0x1p-24F})
            items.push_back({{0, 0, 1}, 0.0F, {x, y}, 1.0F, 1.0F});
    for (const float density : {1e-37F, 1e-20F, 1.0F, 1e20F, 8e37F})
        for (const float other : {0.0F, 1e-37F, 1e-20F, 1.0F, 1e20F, 8e37F})
            items.push_back({{0, 0, 1}, 0.0F, {0, 0}, density, other});
    return items;
}

// The random number x and 1 - x are exact. Their roots have errors of 9 u each. Both rotations add their errors.
Real cosine_hemisphere_bound(const Item &item) {
    const Real sine = std::sqrt(Real{item.numbers.x});
    return rotation_bound(item.axis, sine) + azimuth_bound(sine) + 9 * half_ulp;
}

// 1 - 2 x is exact. The sine 2 sqrt(x (1 - x)) has an error of u / 2 + 9 u.
Real uniform_bound(Real sine) {
    return azimuth_bound(sine) + 9.5L * half_ulp * sine + half_ulp / 2;
}

// If the dot product does not decide the side within its error (2 u and the lengths' deviations from 1), the nearer
// direction counts.
Direction mirrored_up(const Direction &direction, const Item &item, const glm::vec4 &found) {
    const Real cosine = glm::dot(direction, Direction(item.axis));
    const bool undecided = std::abs(cosine) < 4 * half_ulp + uniform_bound(1);
    const Real side = undecided ? glm::dot(direction, Direction(found)) : cosine;
    return side < 0 ? -direction : direction;
}

Direction concentric(const glm::vec2 &numbers) {
    const Real x = 2 * Real{numbers.x} - 1;
    const Real y = 2 * Real{numbers.y} - 1;
    const Real radius = std::max(std::abs(x), std::abs(y));
    if (radius == 0)
        return Direction(0);
    const bool beside = std::abs(x) > std::abs(y);
    const Real angle = beside ? pi / 4 * (y / x) : pi / 2 - pi / 4 * (x / y);
    const Real side = (beside ? x : y) / radius;
    return side * radius * Direction(std::cos(angle), std::sin(angle), 0);
}

// 2 x - 1 is exact for 24 bits. The ratio has an error of 5 u and the angle of 5 pi / 4 u. The product adds u / 2 per
// component.
constexpr Real concentric_share = 5 * pi / 4 * half_ulp;

TEST(AccuracySampling, OfDirectionsAndWeights) {
    const std::vector<Item> all = items();
    Probe probe(sampling_items_spirv(), sizeof(ItemRange));
    const std::vector<Result> results = evaluate<Result>(probe, all);
    Comparison about("direction_about", "length");
    Comparison cosine("cosine_hemisphere_cos_sin", "length");
    Comparison hemisphere("uniform_hemisphere_direction", "length");
    Comparison weight("power_heuristic", "ulp");
    Comparison disc("concentric_disc", "length");
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Item &item = all[i];
        const Result &result = results[i];
        const Real h = item.height;
        const Real u = item.numbers.x;
        const Real turns = item.numbers.y;
        about.add(glm::vec3(result.about), turned_to(item.axis, direction_at(1 - h, std::sqrt(h * (2 - h)), turns)),
                  direction_about_bound(item.axis, h, 0), list(item));
        cosine.add(glm::vec3(result.cosine), turned_to(item.axis, direction_at(std::sqrt(1 - u), std::sqrt(u), turns)),
                   cosine_hemisphere_bound(item), list(item));
        const Real sine = 2 * std::sqrt(u * (1 - u));
        hemisphere.add(glm::vec3(result.hemisphere),
                       mirrored_up(direction_at(1 - 2 * u, sine, turns), item, result.hemisphere), uniform_bound(sine),
                       list(item));
        const Direction point = concentric(item.numbers);
        disc.add(glm::vec3(result.weight.z, result.weight.w, 0.0F), point,
                 glm::length(point) * (concentric_share + azimuth_bound(1)), list(item));
        // In w = 1 / (1 + q^2), q has an error of 5 u and q^2 of 11 u. The sum adds u, and the division adds 2.5 ulp.
        // If a square overflows, the weight is 0.
        const Real a = item.density;
        const Real b = item.other_density;
        add_in_ulp(weight, result.weight.x, a * a / (a * a + b * b), 14.5L, 0x1p-100L, list(item));
    }
    about.finish();
    cosine.finish();
    hemisphere.finish();
    weight.finish();
    disc.finish();
}

} // namespace

} // namespace accuracy::sampling
