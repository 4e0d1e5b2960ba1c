// See first_hit_scenes.h.
#include "tests/device/first_hit_scenes.h"

#include <cstdint>
#include <random>

namespace first_hits {

Given coursework() {
    const CourseworkScene scene;
    return {{scene.materials.begin(), scene.materials.end()},
            {scene.spheres.begin(), scene.spheres.end()},
            {scene.planes.begin(), scene.planes.end()}};
}

std::vector<pt_material> some_materials() {
    return {{{0.8F, 0.4F, 0.2F}, {0.1F, 0.2F, 0.3F}, {0, 0, 0}, 7, 0},
            {{0.9F, 0.1F, 0}, {0.3F, 0, 0}, {0, 0, 0}, 0, 0}, // more than 1 in red
            {{0.25F, 0.5F, 0.75F}, {0, 0, 0}, {30, 20, 10}, 0, 0}};
}

namespace {

Given moving() {
    Given given = coursework();
    given.spheres[2].motion[0] = 4;
    given.spheres[3].motion[1] = -2;
    given.spheres[1].motion[2] = 6;
    given.camera.shutter_open = 0.25;
    given.camera.shutter_close = 0.75;
    return given;
}

// The camera in a ball, in which others are: one of them a lamp, one that moves.
Given inside() {
    Given given;
    given.materials = some_materials();
    given.spheres = {{{0.5, 0, 0}, 9, {0, 0, 0}, 1, 0},
                     {{1, 0.5, -3}, 1, {0, 0, 0}, 0, 0},
                     {{-1.5, -0.5, -4}, 1.25, {0.5, 0.5, 0}, 2, 0}};
    return given;
}

// A globe with a house of its size beside it, and a sky.
Given huge() {
    Given given;
    given.materials = some_materials();
    given.spheres = {{{0, -1e7 - 2, 0}, 1e7, {0, 0, 0}, 1, 0},
                     {{1e4 + 6, 0, -5}, 1e4, {0, 0, 0}, 0, 0},
                     {{0, -1, -6}, 1, {0, 0, 0}, 0, 0},
                     {{0, 0, 0}, 1e9, {0, 0, 0}, 2, 0}};
    return given;
}

// Seen by a telescope, from where float32 would not tell one ball from the other.
Given narrow() {
    Given given;
    given.materials = some_materials();
    given.spheres = {{{0, 0, -1e8}, 3, {0, 0, 0}, 0, 0}, {{4, 2, -1e8 - 5}, 4, {0, 0, 0}, 1, 0}};
    given.planes = {{{0, 0, 1}, 1e8 + 50, 2, 0}};
    given.camera.vertical_fov = 2e-7;
    given.start_distance = 1e8 - 25; // nothing is nearer to that than the view is wide
    return given;
}

// By parallel rays, from a million units away, off the axes: a floor, balls that float32 would not tell apart from
// there, and one that moves.
Given parallel() {
    Given given;
    given.materials = some_materials();
    given.spheres = {{{0, 1, 0}, 1, {0, 0, 0}, 0, 0},
                     {{1.5, 1.5, -40}, 1.25, {0, 0, 0}, 1, 0},
                     {{-1.5, 0.5, 3}, 0.5, {0.5, 0.25, 0}, 2, 0}};
    given.planes = {{{0, 1, 0}, 0, 1, 0}};
    const double back[3] = {3e5, 4e5, 1.2e6};
    for (int i = 0; i < 3; ++i)
        given.camera.position[i] = back[i];
    given.camera.target[1] = 1;
    given.camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
    given.camera.vertical_fov = 0;
    given.camera.vertical_extent = 6;
    given.start_distance = 1.29e6;
    return given;
}

// Parallel rays that start on both sides of a floor, and some of them in a ball.
Given divided() {
    Given given;
    given.materials = some_materials();
    given.spheres = {{{1, 0.5, 0}, 1, {0, 0, 0}, 0, 0}, {{-1, -0.5, -3}, 1, {0, 0, 0}, 1, 0}};
    given.planes = {{{0, 1, 0}, 0.25, 1, 0}, {{0, 0, 1}, 6, 2, 0}};
    given.camera.position[1] = 0.01;
    given.camera.target[2] = -5;
    given.camera.position[0] = given.camera.position[2] = 0.0;
    given.camera.target[0] = 0.5;
    given.camera.target[1] = -0.4;
    given.camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
    given.camera.vertical_fov = 0;
    given.camera.vertical_extent = 4;
    return given;
}

// Parallel rays that start amid the balls of a tree, on both sides of some, of a plane and of a globe.
Given divided_tree() {
    Given given = many(true);
    given.camera.position[0] = given.camera.position[1] = 0.0;
    given.camera.position[2] = -6.0;
    given.camera.target[0] = 1.0;
    given.camera.target[1] = -0.5;
    given.camera.target[2] = -9.0;
    given.camera.projection = PT_PROJECTION_ORTHOGRAPHIC;
    given.camera.vertical_fov = 0;
    given.camera.vertical_extent = 6.5;
    return given;
}

// Far from the origin of the world, off the axes.
Given far_away() {
    Given given;
    given.materials = some_materials();
    const double far[3] = {3e9, -2e9, 1e9};
    for (int i = 0; i < 3; ++i) {
        given.camera.position[i] = far[i];
        given.camera.target[i] = far[i] + (i == 1 ? -0.5 : 3);
    }
    given.camera.up[0] = 0.25;
    given.spheres = {{{far[0] + 6, far[1] - 1, far[2] + 6}, 2, {0, 0, 0}, 0, 0}};
    given.planes = {{{0, 2, 0}, 4e9 + 8, 1, 0}};
    return given;
}

} // namespace

// So many that there is a tree, with a globe beside it that is too large for it, and planes; some move.
Given many(bool moves) {
    Given given;
    given.materials = some_materials();
    std::mt19937 random(5);
    const auto share = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
    for (std::uint32_t i = 0; i < 400; ++i) {
        pt_sphere sphere{
            {6 * share() - 3, 4 * share() - 2, -4 - 6 * share()}, 0.05 + 0.3 * share(), {0, 0, 0}, i % 3, 0};
        if (moves && i % 2 == 0)
            sphere.motion[0] = share() - 0.5;
        given.spheres.push_back(sphere);
    }
    given.spheres.insert(given.spheres.begin() + 100, {{0, -1e6 - 3, 0}, 1e6, {0, 0, 0}, 1, 0});
    given.planes = {{{0, 0, 1}, 12, 0, 0}, {{1, 0, 0.1}, 7, 2, 0}};
    given.camera.shutter_close = 0.5;
    return given;
}

namespace {

// Without what is made of one of the materials, for the camera.
Given hiding(Given given, std::uint32_t material) {
    given.materials[material].flags = PT_MATERIAL_HIDDEN_FROM_CAMERA;
    return given;
}

} // namespace

std::vector<Case> cases() {
    return {{"coursework", coursework()},
            {"moving", moving()},
            {"inside", inside()},
            {"huge", huge()},
            {"narrow", narrow()},
            {"far away", far_away()},
            {"parallel", parallel()},
            {"divided", divided()},
            {"a tree", many(false)},
            {"a tree that moves", many(true)},
            {"a divided tree", divided_tree()},
            {"a hidden ball around the camera", hiding(inside(), 1)},
            {"a hidden globe", hiding(huge(), 1)},
            {"a hidden sky", hiding(huge(), 2)},
            {"hidden lamps", hiding(divided(), 2)},
            {"hidden, of a tree", hiding(many(true), 1)}};
}

} // namespace first_hits
