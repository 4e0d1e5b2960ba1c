#include "lib/view/scene_features.h"

#include "lib/tree/tree_choice.h"
#include "lib/view/lamp.h"
#include "lib/view/lamp_tree.h"
#include "lib/view/lamp_tree_words.h"
#include "lib/view/scene_blocks.h"
#include "lib/view/seen_scene.h"

#include <pt/stats.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>

namespace pt {

// A walk traces up to two rays. Among 10^6 spheres, the longest ray of invocations in lockstep takes about 100 trips.
// Samples that need more than tree_trips are lost and reported (walk_was_cut in tree_walk.glsl).
std::uint64_t loop_trips_per_walk(const Features &features) {
    constexpr std::uint64_t tree_trips = 200;
    return features.surface_count() + (features[gpu::ID_TREE] ? tree_trips : 0);
}

bool samples_lamps(const Features &features) {
    return gpu::samples_lamps(features[gpu::ID_ESTIMATOR]) && features[gpu::ID_MAX_PATH_LENGTH] > 1;
}

namespace {

// Whether a sphere lies in the convex region around the camera between the planes.
bool is_in_region(const std::vector<CurvedPlane> &planes, const SeenSphere &sphere) {
    const std::array way = {sphere.open, sphere.close()};
    return std::ranges::all_of(planes, [&](const CurvedPlane &plane) {
        return plane.offset > 0.0 && std::ranges::all_of(way, [&](const glm::dvec3 &center) {
                   return glm::dot(plane.normal, center) + plane.offset > sphere.radius;
               });
    });
}

bool is_in_region(const std::vector<CurvedPlane> &planes, const PointBox &box, const Camera &camera) {
    return std::ranges::all_of(planes, [&](const CurvedPlane &plane) {
        const glm::dvec3 nearest = glm::mix(box.low, box.high, glm::lessThan(plane.normal, glm::dvec3(0.0)));
        return plane.offset > 0.0 && glm::dot(plane.normal, nearest - camera.position) + plane.offset > 0.0;
    });
}

bool has_known_side(const CurvedPlane &plane) {
    return static_cast<float>(plane.offset) != 0.0F;
}

// Whether lamps outside the tree light an open scene's middle over twice as much as skies. Most noise then comes
// from shadows, which branches share.
bool lamps_outshine_skies(const KernelSurfaces &surfaces, const std::vector<Material> &materials,
                          const SphereTree *tree, const Camera &camera) {
    const std::span<const SeenSphere> spheres = surfaces.spheres;
    const auto emission = [&](const SeenSphere &sphere) { return double{mean(materials[sphere.material].emission)}; };
    const auto others = spheres.subspan(surfaces.lamp_count + surfaces.sky_count);
    if (surfaces.planes.size() > 1 || (!tree && others.empty()))
        return false;
    glm::dvec3 middle{0.0};
    if (tree)
        middle = 0.5 * (tree->bounds().low + tree->bounds().high) - camera.position;
    else
        for (const SeenSphere &sphere : others)
            middle += sphere.open / static_cast<double>(others.size());

    double lamps = 0.0;
    for (const SeenSphere &lamp : spheres.first(surfaces.lamp_count)) {
        const double sine = std::min(lamp.radius / glm::length(lamp.open - middle), 1.0);
        lamps += emission(lamp) * sine * sine;
    }
    double skies = 0.0;
    for (const SeenSphere &sky : spheres.subspan(surfaces.lamp_count, surfaces.sky_count))
        skies += emission(sky);
    return skies > 0.0 && lamps > 2.0 * skies;
}

// These counts need the least time for a given error. Empirical.
std::uint32_t branches_among(std::size_t sphere_count, std::uint32_t max_path_length, bool gloss, bool shadows) {
    constexpr std::size_t very_many = 4096;
    if ((sphere_count >= very_many && max_path_length > 3) || (!gloss && shadows))
        return 1;
    return sphere_count >= default_tree_from || !gloss ? 2 : 4;
}

std::uint32_t rounded_up(std::uint32_t levels) {
    constexpr std::uint32_t step = 4;
    return (levels + step - 1) / step * step;
}

// Counts two loops over the lamps or, with a lamp tree, one over the top groups and two down the levels.
std::uint64_t lamp_trips(const Features &features) {
    return features[gpu::ID_LAMP_TREE_LEVELS] ? gpu::LAMP_TREE_TOP_GROUPS + 2 * features[gpu::ID_LAMP_TREE_LEVELS]
                                              : 2 * std::uint64_t{features[gpu::ID_LAMP_COUNT]};
}

std::uint64_t loop_trips_per_branch(const Features &features) {
    const std::uint64_t vertex = 1 + lamp_trips(features) + loop_trips_per_walk(features);
    return (features[gpu::ID_MAX_PATH_LENGTH] - 1) * vertex;
}

} // namespace

Features features_of(const SeenScene &distinct, const KernelSurfaces &surfaces, const PreparedScene &scene,
                     const Camera &camera, const RenderSettings &render) {
    const auto lamps = std::span(surfaces.spheres).first(surfaces.lamp_count);
    const auto glows = [&](const CurvedPlane &plane) { return emits(scene.scene.materials[plane.material]); };
    const auto is_behind_a_plane = [&](const SeenSphere &lamp) { return !is_in_region(distinct.planes, lamp); };
    const auto divides = [&](const auto &surface) { return divides_start(surface, camera); };
    const auto is_at_camera = [&](const SeenSphere &sphere) { return may_hold_origin(sphere) || divides(sphere); };
    const auto lies_apart = [&](const SeenSphere &sphere) {
        return pt::lies_apart(sphere, distinct, scene.tree.get(), camera);
    };
    const auto may_hold_paths = [&](const SeenSphere &sphere) {
        return sphere.hidden ? !lies_apart(sphere) : is_at_camera(sphere);
    };
    // Paths may lie behind hidden surfaces.
    const auto is_passed = [&](const SeenSphere &sphere) {
        return sphere.hidden && (may_hold_origin(sphere) || !lies_apart(sphere));
    };
    const bool planes_are_passed =
        std::ranges::any_of(surfaces.planes, [](const CurvedPlane &plane) { return plane.hidden; });
    const bool planes_divide = std::ranges::any_of(distinct.planes, divides);
    const SphereTree *const tree = scene.tree.get();
    const auto tree_lamps = tree ? static_cast<std::uint32_t>(tree->lamp_materials().size()) : 0;
    const std::uint32_t lamp_count = surfaces.lamp_count + tree_lamps;

    Features features;
    features[gpu::ID_SPHERE_COUNT] = static_cast<std::uint32_t>(surfaces.spheres.size());
    features[gpu::ID_PLANE_COUNT] = static_cast<std::uint32_t>(surfaces.planes.size());
    const std::size_t sphere_count = scene.scene.spheres.size() + (tree ? tree->sphere_count() : 0);
    features[gpu::ID_TREE] = tree != nullptr;
    for (const LookColumn &look : look_columns)
        features[look.constant] = tree && tree->has(look.column);
    features[gpu::ID_TREE_LAMPS] = tree_lamps;
    features[gpu::ID_LAMP_COUNT] = lamp_count;
    features[gpu::ID_SKY_COUNT] = surfaces.sky_count;
    features[gpu::ID_HIDDEN_LAMPS] = surfaces.hidden.lamps;
    features[gpu::ID_HIDDEN_SKIES] = surfaces.hidden.skies;
    features[gpu::ID_HIDDEN_OTHERS] = surfaces.hidden.others;
    features[gpu::ID_HIDDEN_PLANES] = surfaces.hidden.planes;
    features[gpu::ID_CURVATURE] = surfaces.planes.size() > distinct.planes.size();
    features[gpu::ID_TREE_LEVELS] = tree ? rounded_up(tree->depth()) : 0;
    features[gpu::ID_TREE_OPACITY] = tree && tree->has_opacities();
    features[gpu::ID_TREE_INSIDE] =
        features[gpu::ID_TREE_OPACITY] || (tree && (tree->may_hold(camera) || tree->divides_start(camera)));
    features[gpu::ID_INSIDE] = features[gpu::ID_TREE_INSIDE] || std::ranges::any_of(surfaces.spheres, may_hold_paths);
    features[gpu::ID_PLANES_EMIT] = std::ranges::any_of(surfaces.planes, glows);
    // Curved planes may bulge towards the camera.
    features[gpu::ID_PLANES_BLOCK] = features[gpu::ID_CURVATURE] || planes_divide || planes_are_passed ||
                                     std::ranges::any_of(lamps, is_behind_a_plane) ||
                                     (tree_lamps > 0 && !is_in_region(distinct.planes, tree->bounds(), camera));
    // Sides are not known if rays start on both sides of a surface or pass through it. Distinct flat planes do not need
    // known sides.
    const bool starts_divided = distinct.any_surface(divides) || (tree && tree->divides_start(camera));
    const bool some_are_passed = planes_are_passed || std::ranges::any_of(distinct.spheres, is_passed);
    features[gpu::ID_KNOWN_SIDES] =
        !starts_divided && !some_are_passed && !features[gpu::ID_TREE_OPACITY] &&
        (features[gpu::ID_INSIDE] || features[gpu::ID_CURVATURE] || distinct.close_planes) &&
        std::ranges::all_of(surfaces.planes, has_known_side);
    features[gpu::ID_CLOSE_LAMPS] =
        features[gpu::ID_LAMP_COUNT] > 0 && (distinct.close_lamps || (tree && tree->has_close_lamps()));
    features[gpu::ID_STARTS_AHEAD] = camera.start_distance > 0.0 || camera.start_radius > 0.0;
    features[gpu::ID_PROJECTION] = camera.projection;
    features[gpu::ID_LENS] = camera.has_lens();
    features[gpu::ID_MAX_PATH_LENGTH] = render.max_path_length;
    features[gpu::ID_ESTIMATOR] = render.estimator;
    features[gpu::ID_SAMPLER] = render.sampler;
    features[gpu::ID_COVERAGE] = render.coverage;
    features[gpu::ID_GLOSS] = scene.gloss;
    const bool shadows = samples_lamps(features) && lamps_outshine_skies(surfaces, scene.scene.materials, tree, camera);
    features.most_branches = branches_among(sphere_count, render.max_path_length, scene.gloss, shadows);
    // The tree has positions at time 0.
    const bool tree_is_late = tree && tree->moves() && camera.shutter_open > 0.0;
    features[gpu::ID_MOTION] = scene.moves && (camera.shutter_close > camera.shutter_open || tree_is_late);
    Kinds kinds = tree ? tree->kinds() : Kinds();
    features[gpu::ID_TREE_KINDS] = kinds.bits();
    for (const SeenSphere &sphere : surfaces.spheres)
        kinds.add(sphere.kind);
    features[gpu::ID_KINDS] = kinds.bits();
    features[gpu::ID_SCENE_SOURCE] = gpu::SCENE_IN_UNIFORM;
    if (tree || SceneBlocks(features).word_count > gpu::UNIFORM_SCENE_WORDS) {
        features[gpu::ID_SCENE_SOURCE] = gpu::SCENE_IN_STORAGE;
        features.table_materials = static_cast<std::uint32_t>(scene.used_materials.size());
    }
    if (lamp_count >= least_tree_lamps && samples_lamps(features)) {
        features[gpu::ID_LAMP_TREE_LEVELS] = LampTreeShape(lamp_count).levels();
        features[gpu::ID_LAMP_TREE_WORDS] =
            static_cast<std::uint32_t>(lamp_tree_words(lamp_count, features[gpu::ID_MOTION]));
    }
    return features;
}

std::uint32_t branch_count(const Features &features) {
    const bool spots_find_most = features[gpu::ID_SPOT_COUNT] > 0 && features[gpu::ID_MAX_PATH_LENGTH] == 3;
    const std::uint32_t branches = std::min(features.most_branches, spots_find_most ? 2U : 4U);
    constexpr std::uint64_t max_trips = 1 << 14;
    const bool affordable = branches * loop_trips_per_branch(features) <= max_trips;
    return features[gpu::ID_MAX_PATH_LENGTH] > 2 && affordable ? branches : 1;
}

namespace {

std::uint32_t further_lamps(const Features &features, std::uint32_t branches) {
    const std::uint32_t lamps = features[gpu::ID_LAMP_COUNT] > gpu::EVERY_LAMP_LIMIT ? 0 : features[gpu::ID_LAMP_COUNT];
    return lamps - std::min(lamps, branches);
}

} // namespace

PointLayout point_layout(const Features &features) {
    std::vector<std::uint32_t> blocks(1 + features[gpu::ID_LENS], 2);
    blocks.front() = gpu::camera_dimensions(features[gpu::ID_MOTION]);
    const auto of_camera = static_cast<std::uint32_t>(blocks.size());
    const std::uint32_t shared =
        gpu::shared_blocks(of_camera, features[gpu::ID_LAMP_COUNT], features[gpu::ID_SPOT_COUNT]);
    const std::uint32_t branches = branch_count(features);
    if (features[gpu::ID_SAMPLER] == PT_SAMPLER_RANDOM)
        return {{}, 0, branches};
    blocks.resize(shared, 2);
    const std::uint32_t direction =
        gpu::direction_dimensions(features[gpu::ID_GLOSS], features[gpu::ID_MAX_PATH_LENGTH]);
    if (features[gpu::ID_SPOT_COUNT] > 0) {
        const std::uint32_t spot = gpu::every_lamp_blocks(of_camera, features[gpu::ID_LAMP_COUNT]);
        blocks[spot] = 3;
        blocks[spot + 1] = gpu::chosen_lamp_dimensions(2, features[gpu::ID_LAMP_COUNT]);
        blocks[spot + 2] = direction;
    }
    std::uint32_t left = sequence_dimensions - std::accumulate(blocks.begin(), blocks.end(), 0U);
    for (std::uint32_t vertex = 1; vertex < features[gpu::ID_MAX_PATH_LENGTH]; ++vertex) {
        const std::uint32_t lamp = gpu::chosen_lamp_dimensions(vertex, features[gpu::ID_LAMP_COUNT]);
        if (lamp + direction > left)
            break;
        if (lamp > 0)
            blocks.push_back(lamp);
        blocks.push_back(direction);
        left -= lamp + direction;
    }
    return {blocks, shared, branches};
}

std::array<std::uint32_t, gpu::CONSTANT_COUNT> specialization_constants(const Features &features) {
    const PointLayout layout = point_layout(features);
    auto constants = features.constants;
    constants[gpu::ID_TABLE_BLOCKS] = layout.block_count();
    constants[gpu::ID_BRANCH_COUNT] = layout.branches;
    constants[gpu::ID_UNROLLED] = gpu::CONSTANT_SCENE_WORDS;
    return constants;
}

std::uint64_t loop_trips_per_sample(const Features &features) {
    const std::uint64_t walk = loop_trips_per_walk(features);
    const std::uint32_t branches = branch_count(features);
    const std::uint64_t first_vertex = further_lamps(features, branches) * (1 + walk) + lamp_trips(features);
    const std::uint64_t way =
        features[gpu::ID_SPOT_COUNT] > 0
            ? std::uint64_t{4 + branches} * features[gpu::ID_SPOT_COUNT] + 2 * walk + lamp_trips(features)
            : 0;
    return 1 + walk + way + first_vertex + branches * loop_trips_per_branch(features);
}

double surface_tests_per_ray(const Features &features, const SphereTree *tree) {
    constexpr double tests_of_node = 4.0;
    const double tests = features.surface_count() + (tree ? tests_of_node * tree->cost() : 0.0);
    return std::max(1.0, tests);
}

double surface_tests_per_path(const Features &features, const SphereTree *tree) {
    const std::uint32_t branches = branch_count(features);
    const std::uint64_t vertices = std::uint64_t{branches} * (features[gpu::ID_MAX_PATH_LENGTH] - 1);
    const std::uint32_t by_spot = features[gpu::ID_SPOT_COUNT] > 0 ? 3 : 0;
    return surface_tests_per_ray(features, tree) *
           static_cast<double>(1 + further_lamps(features, branches) + by_spot + 2 * vertices);
}

std::uint32_t feature_bits(const Features &features) {
    struct {
        std::uint32_t id;
        std::uint32_t bit;
    } constexpr bits_of_constants[] = {
        {gpu::ID_LAMP_COUNT, PT_FEATURE_LAMPS},
        {gpu::ID_GLOSS, PT_FEATURE_GLOSS},
        {gpu::ID_MOTION, PT_FEATURE_MOTION},
        {gpu::ID_TREE, PT_FEATURE_TREE},
        {gpu::ID_HIDDEN_LAMPS, PT_FEATURE_HIDDEN},
        {gpu::ID_HIDDEN_SKIES, PT_FEATURE_HIDDEN},
        {gpu::ID_HIDDEN_OTHERS, PT_FEATURE_HIDDEN},
        {gpu::ID_HIDDEN_PLANES, PT_FEATURE_HIDDEN},
        {gpu::ID_LENS, PT_FEATURE_LENS},
        {gpu::ID_TREE_OPACITY, PT_FEATURE_OPACITY},
    };
    std::uint32_t bits = features.scene_in_uniform() ? 0 : PT_FEATURE_LARGE;
    if ((features[gpu::ID_KINDS] & gpu::KIND_CAPSULE) != 0)
        bits |= PT_FEATURE_CAPSULES;
    if (features[gpu::ID_PROJECTION] == PT_PROJECTION_ORTHOGRAPHIC)
        bits |= PT_FEATURE_ORTHOGRAPHIC;
    for (const auto &[id, bit] : bits_of_constants)
        bits |= features[id] > 0 ? bit : 0;
    return bits;
}

} // namespace pt
