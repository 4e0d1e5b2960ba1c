// The scenes of `pt selftest`, whose images are known exactly, the judgement of an image of one, and the report of all.
// The scenes are few and small, and look for what may be wrong on a single device: other roundings, lamps of extreme
// sizes, lobes of extreme sharpness, motion.
#pragma once

#include "cli/scene/scene_file.h"

#include <pt/devices.h>

#include <span>
#include <string>
#include <vector>

namespace cli {

struct SelftestCheck {
    std::string group; // "function", "scene", "invariance" or "directions"
    std::string name;
    double error; // infinite where nothing finite was measured
    double bound;
    std::string unit;
    std::string detail; // what was measured, for a report of the fault

    // Written so that an error that is not a number fails.
    bool passed() const { return error <= bound; }
};

struct SelftestScene {
    std::string name;
    SceneFile scene;
    double expected;     // radiance of the whole image, grey, to this power
    double relative_std; // of that of one sample, at most; 0: every sample of every pixel has the same value
    double rounding;     // largest relative error of a sample that float32 may make
    int power = 1;       // 0: expected is the share of pixels that are not black

    // How far the image may be off, as a multiple of what is expected.
    double bound() const;

    // Without noise every number of the image is judged, else the mean of each channel: the worst of them counts.
    SelftestCheck judge(std::span<const float> radiance) const;
};

// All of them.
std::vector<SelftestScene> selftest_scenes();

// The one of them with the longest paths.
SelftestScene lamp_in_a_ball();

// Scenes whose samples are cosines of the directions that kernels sample, in means, second moments and sides.
std::vector<SelftestScene> direction_scenes();

struct SelftestReport {
    pt_device_info device;
    std::vector<SelftestCheck> checks;

    bool passed() const;
};

// The device, a line for every check, and the verdict.
std::string selftest_text(const SelftestReport &report);

nlohmann::ordered_json selftest_json(const SelftestReport &report);

} // namespace cli
