// The exact scenes of `pt selftest`: rounding, extreme lamps and lobes, motion.
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
    double error; // infinite if nothing finite was measured
    double bound;
    std::string unit;
    std::string detail; // the measurement

    // NaN fails.
    bool passed() const { return error <= bound; }
};

struct SelftestScene {
    std::string name;
    SceneFile scene;
    double expected;     // mean of radiance^power over the image, which is grey
    double relative_std; // bound of a sample's standard deviation / expected; 0: all samples are equal
    double rounding;     // largest relative float32 error of a sample
    int power = 1;       // 0: expected is the share of pixels that are not black

    // Largest permitted error relative to expected.
    double bound() const;

    // Judges every number without noise, otherwise each channel's mean.
    SelftestCheck judge(std::span<const float> radiance) const;
};

std::vector<SelftestScene> selftest_scenes();

SelftestScene lamp_in_a_ball();

// Scenes whose light is found in several ways, each of which has a good part of it. A weight of multiple importance
// sampling that is wrong by 2% moves the mean by at least twice the bound, so it is noticed as surely as a right one
// passes.
std::vector<SelftestScene> weight_scenes();

// Samples are cosines of sampled directions: means, second moments, and the share on each side.
std::vector<SelftestScene> direction_scenes();

struct SelftestReport {
    pt_device_info device;
    std::vector<SelftestCheck> checks;

    bool passed() const;
};

std::string selftest_text(const SelftestReport &report);

nlohmann::ordered_json selftest_json(const SelftestReport &report);

} // namespace cli
