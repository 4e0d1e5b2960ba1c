// Compares an edited kernel with the library's, by rendering until the test decides.
#pragma once

#include "cli/compare/light.h"
#include "cli/scene/scene_override.h"

#include <functional>
#include <string>
#include <vector>

namespace cli {

struct KernelTask {
    std::string scene;
    std::vector<SceneOverride> overrides;
    std::string shader_dir;
    std::string device;
    LightRule rule;
};

// told: receives each look's verdict, with the samples so far.
using TellLook = std::function<void(std::uint32_t samples, const LightVerdict &verdict)>;

// Looks after 16 samples and whenever they have doubled, up to the scene's number or 65536. Throws Failure.
LightVerdict compare_kernels(const KernelTask &task, const TellLook &told);

} // namespace cli
