// The directions in which paths leave surfaces, as the kernel samples them: what `pt selftest --directions` checks.
#pragma once

#include "cli/selftest/selftest_check.h"
#include "cli/selftest/selftest_scene.h"

#include <span>
#include <vector>

namespace cli {

// A floor under a sky of radiance 1, seen from straight above by parallel rays, one sample to a pixel. A direction of
// cosine c has density proportional to c^power about the normal, and its sample is scale * c. A wall is
// a black plane that stands upright beside the camera's rays and takes half of all directions.
struct DirectionScene {
    SelftestScene scene;
    double power;
    double scale;
    bool has_wall;

    // Against exact values, in standard errors that follow from them: of open skies the means of c and c^2, behind a
    // wall the share of directions that meet none.
    std::vector<SelftestCheck> judge(std::span<const float> radiance) const;
};

std::vector<DirectionScene> direction_scenes();

} // namespace cli
