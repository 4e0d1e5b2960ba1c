// The scenes of `pt selftest`, whose images are known exactly, the judgement of their images, and the report. The
// scenes are few and small, and test what may be wrong on a single device: roundings, lamps of extreme sizes, lobes of
// extreme sharpness, motion.
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

    // Written so that NaN fails.
    bool passed() const { return error <= bound; }
};

struct SelftestScene {
    std::string name;
    SceneFile scene;
    double expected;     // mean of radiance^power over the image, which is grey
    double relative_std; // upper bound of a sample's standard deviation / expected; 0: all samples are equal
    double rounding;     // largest relative error of a sample that float32 may make
    int power = 1;       // 0: expected is the share of pixels that are not black

    // How far the image may be off, relative to expected.
    double bound() const;

    // Judges every number of the image if there is no noise, otherwise the mean of each channel; the worst counts.
    SelftestCheck judge(std::span<const float> radiance) const;
};

// All scenes.
std::vector<SelftestScene> selftest_scenes();

// The scene with the longest paths.
SelftestScene lamp_in_a_ball();

// Scenes whose samples are cosines of sampled directions. They test means, second moments and the share on each side.
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
