// The scenes of `pt selftest`, whose images are known exactly, and the judgement of an image of one.
#pragma once

#include "cli/selftest/selftest_check.h"

#include <pt/pt.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cli {

struct SelftestScene {
    std::string name;
    std::vector<pt_material> materials;
    std::vector<pt_sphere> spheres;
    std::vector<pt_plane> planes;
    pt_camera camera;
    pt_render render;
    std::uint32_t sample_count;
    double expected;     // radiance of the whole image, grey
    double relative_std; // of one sample, at most; 0: every sample of every pixel has the same value
    double rounding;     // largest relative error of a sample that float32 may make

    pt_scene scene() const; // points into this object

    // How far the image may be off, as a multiple of what is expected.
    double bound() const;

    // Without noise every number of the image is judged, else the mean of each channel: the worst of them counts.
    SelftestCheck judge(std::span<const float> radiance) const;
};

// All of them.
std::vector<SelftestScene> selftest_scenes();

// The one of them with the longest paths.
SelftestScene lamp_in_a_ball();

} // namespace cli
