#pragma once

#include "lib/points/point_sequence.h"
#include "lib/scene/camera.h"
#include "lib/scene/render_settings.h"
#include "lib/view/kernel_surfaces.h"
#include "lib/view/prepared_scene.h"
#include "shaders/specialization.h"

#include <array>
#include <cstdint>

namespace pt {

struct Features {
    // Indexed by gpu::ID_*. Constants that depend on the device are set later.
    std::array<std::uint32_t, gpu::CONSTANT_COUNT> constants{};
    std::uint32_t most_branches = 0; // branches at a path's first vertex
    std::uint32_t table_materials = 0;

    bool operator==(const Features &) const = default;

    std::uint32_t &operator[](std::uint32_t id) { return constants[id]; }
    std::uint32_t operator[](std::uint32_t id) const { return constants[id]; }

    bool scene_in_uniform() const { return constants[gpu::ID_SCENE_SOURCE] == gpu::SCENE_IN_UNIFORM; }
    bool has_ways() const { return constants[gpu::ID_MOTION] > 0 || constants[gpu::ID_KINDS] > gpu::KIND_BALL; }
    std::uint32_t surface_count() const { return constants[gpu::ID_SPHERE_COUNT] + constants[gpu::ID_PLANE_COUNT]; }
    std::uint32_t emitting_spheres() const { return constants[gpu::ID_LAMP_COUNT] + constants[gpu::ID_SKY_COUNT]; }
    std::uint32_t walked_lamps() const { return constants[gpu::ID_LAMP_COUNT] - constants[gpu::ID_TREE_LAMPS]; }
};

Features features_of(const SeenScene &distinct, const KernelSurfaces &surfaces, const PreparedScene &scene,
                     const Camera &camera, const RenderSettings &render);

bool samples_lamps(const Features &features);

// Branches share a path's camera ray and first vertex, because most noise comes from later vertices. Otherwise fewer
// branches suffice. There is 1 if a sample takes nearly 65535 loop trips, a driver's limit.
std::uint32_t branch_count(const Features &features);

PointLayout point_layout(const Features &features);

std::array<std::uint32_t, gpu::CONSTANT_COUNT> specialization_constants(const Features &features);

// Returns an upper bound, without unrolled loops.
std::uint64_t loop_trips_per_sample(const Features &features);

std::uint64_t loop_trips_per_walk(const Features &features);

double surface_tests_per_path(const Features &features, const SphereTree *tree);

double surface_tests_per_ray(const Features &features, const SphereTree *tree);

std::uint32_t feature_bits(const Features &features);

} // namespace pt
