#include "shaders/specialization.h"
#include "tests/accuracy/direction.h"
#include "tests/accuracy/evaluation.h"
#include "vertex_items.spv.h"

#include <gtest/gtest.h>

namespace accuracy::vertex {

namespace {

constexpr std::uint32_t sphere_count = 512;
constexpr std::uint32_t plane_count = 512;

struct Item {
    glm::vec3 origin;
    std::uint32_t surface;
    glm::vec3 direction;
    float distance;
};

struct Result {
    glm::vec3 position;
    float inside;
    glm::vec4 normal;
    glm::vec4 mirror;
};

std::vector<glm::vec4> surfaces() {
    Inputs inputs(8);
    std::vector<glm::vec4> surfaces;
    for (std::uint32_t i = 0; i < sphere_count + plane_count; ++i) {
        const auto size = static_cast<float>(inputs.log_uniform(1e-2, 1e4));
        const auto place = static_cast<float>(inputs.log_uniform(1e-2, 1e4));
        const glm::vec3 direction = inputs.direction();
        surfaces.push_back(i < sphere_count ? glm::vec4(place * direction, size) : glm::vec4(direction, place));
    }
    return surfaces;
}

std::vector<Item> items(const std::vector<glm::vec4> &surfaces) {
    Inputs inputs(9);
    std::vector<Item> items;
    for (std::uint32_t i = 0; i < random_count; ++i) {
        const std::uint32_t surface = i % (sphere_count + plane_count);
        const glm::dvec3 center_or_normal(surfaces[surface]);
        const double size = double{surfaces[surface].w};
        glm::dvec3 point = size * inputs.log_uniform(1e-2, 1e2) * glm::dvec3(inputs.direction());
        if (surface < sphere_count)
            point = center_or_normal + size * glm::dvec3(inputs.direction());
        else
            point -= (glm::dot(center_or_normal, point) + size) * center_or_normal;
        const double distance = size * inputs.log_uniform(1e-1, 1e2);
        const glm::dvec3 direction(inputs.direction());
        items.push_back({glm::vec3(point - distance * direction), surface, glm::vec3(direction),
                         static_cast<float>(distance * (1.0 + 2e-3 * (inputs.number() - 0.5)))});
    }
    return items;
}

// Let u = 2^-24. For spheres, radius times normalize() has an error of 15.5 u, the product adds u, and the sum adds u
// |p|. For planes, normal . p + offset has an error of 2 u |p| + u, the correction has a relative error of 3 u, and the
// difference adds u |p|. If the normal's length is 1 + l, the error of the height is 2 l times the height.
Real sphere_bound(const glm::vec4 &sphere, const Direction &point) {
    return half_ulp * (16.5L * sphere.w + glm::length(point));
}

Real plane_bound(const glm::vec4 &plane, const Direction &point, Real height) {
    return half_ulp * (4 * glm::length(point) + 5 * std::abs(height)) +
           2 * length_error(glm::vec3(plane)) * std::abs(height);
}

TEST(AccuracyVertex, OfPoints) {
    const std::vector<glm::vec4> all_surfaces = surfaces();
    const std::vector<Item> all = items(all_surfaces);
    std::vector<std::uint32_t> constants(pt::gpu::CONSTANT_COUNT);
    constants[pt::gpu::ID_SPHERE_COUNT] = sphere_count;
    constants[pt::gpu::ID_PLANE_COUNT] = plane_count;
    constants[pt::gpu::ID_SCENE_SOURCE] = pt::gpu::SCENE_IN_UNIFORM;
    Probe probe(vertex_items_spirv(), sizeof(ItemRange), constants);
    probe.set_scene(all_surfaces);
    const std::vector<Result> results = evaluate<Result>(probe, all);

    Comparison from_sphere("vertex_at, sphere", "of |point| + size");
    Comparison from_plane("vertex_at, plane", "of |point| + size");
    Comparison mirror("vertex_at, mirror", "length");
    std::size_t inside = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Item &item = all[i];
        const glm::vec4 &surface = all_surfaces[item.surface];
        const Direction position(results[i].position);
        const Direction normal(results[i].normal);
        const std::vector<float> input = list(item.origin, item.direction, item.distance, surface);
        const Direction reached = Direction(item.origin) + Real{item.distance} * Direction(item.direction);
        const Real scale = glm::length(position) + std::abs(surface.w);
        if (item.surface < sphere_count) {
            const Real height = glm::length(position - Direction(surface)) - surface.w;
            from_sphere.add(height / scale, 0, sphere_bound(surface, position) / scale, input);
        } else {
            const Real height_before = glm::dot(Direction(surface), reached) + surface.w;
            const Real height = glm::dot(Direction(surface), position) + surface.w;
            from_plane.add(height / scale, 0, plane_bound(surface, reached, height_before) / scale, input);
        }
        // A dot product has an error of 3 u.
        EXPECT_LE(glm::dot(normal, Direction(item.direction)), 3 * half_ulp) << "not on the side of the ray's start";
        inside += results[i].inside == 1.0F ? 1 : 0;
        // 2 (n . d) n has an error of 4 u + 2 u, and the difference adds u. A ray along the surface is its own mirror
        // image.
        mirror.add(glm::vec3(results[i].mirror), glm::reflect(Direction(item.direction), normal), 7 * half_ulp, input);
    }
    EXPECT_TRUE(inside > 0 && inside < all.size()) << "only one side was tested";
    from_sphere.finish();
    from_plane.finish();
    mirror.finish();
}

} // namespace

} // namespace accuracy::vertex
