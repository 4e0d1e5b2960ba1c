#pragma once

#include "cli/base/context.h"
#include "cli/scene/scene.h"

#include <pt/devices.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cli {

inline constexpr double unit_roundoff = 0x1p-24; // float32

// Largest relative float32 error of a sample, for 50 operations. Vulkan permits 2.5 ulp, which are 5 roundoffs, for
// division, the least exact one.
inline constexpr double sample_rounding = 50 * 5 * unit_roundoff;

struct SelftestCheck {
    std::string group;
    std::string name;
    double error; // infinite without a finite measurement
    double bound;
    std::string unit;
    std::string detail;

    bool passed() const { return error <= bound; }
};

struct SelftestScene {
    std::string name;
    SceneFile scene;
    double expected;     // mean of radiance^power; the image is grey
    double relative_std; // bound of a sample's standard deviation / expected; 0 if all samples are equal
    double rounding;     // largest relative float32 error of a sample
    int power = 1;       // 0 if `expected` is the fraction of pixels that are not black

    double bound() const;

    // Judges each number or, if samples differ, the mean of each channel.
    SelftestCheck judge(std::span<const float> radiance) const;
};

std::vector<SelftestScene> selftest_scenes();

SelftestScene lamp_in_a_ball();

// With an error of 2% in a weight of multiple importance sampling, the mean would differ by at least twice the bound.
std::vector<SelftestScene> weight_scenes();

// Samples are cosines of sampled directions. The checks are means, second moments, and the fraction of directions on
// each side.
std::vector<SelftestScene> direction_scenes();

// Renders in several calls and returns three values a pixel.
std::vector<float> render_radiance(const Context &context, const SceneFile &scene,
                                   const std::vector<std::uint32_t> &sample_counts);

struct SelftestReport {
    pt_device_info device;
    std::vector<SelftestCheck> checks;

    bool passed() const;
};

std::string selftest_text(const SelftestReport &report);

nlohmann::ordered_json selftest_json(const SelftestReport &report);

} // namespace cli
