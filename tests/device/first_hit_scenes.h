// Scenes of which tests ask what camera rays meet first: moving, divided by what the camera is in, huge, tiny, far
// away, with parallel rays, and so many spheres that there is a tree.
#pragma once

#include "tests/support/coursework_scene.h"
#include "tests/support/scene_of.h"

#include <cstdint>
#include <string>
#include <vector>

namespace first_hits {

struct Given {
    std::vector<pt_material> materials;
    std::vector<pt_sphere> spheres;
    std::vector<pt_plane> planes;
    pt_camera camera = CourseworkScene::camera();
    double start_distance = 0.0; // how far ahead of the camera float32 numbers begin, at the least

    pt_scene scene() const { return scene_of(materials, spheres, planes); }
};

// A glossy one, one that gives off more red than it receives, and a lamp.
std::vector<pt_material> some_materials();

Given coursework();

// Four hundred and one spheres and planes.
Given many(bool moves);

struct Case {
    std::string name;
    Given given;
};

std::vector<Case> cases();

} // namespace first_hits
