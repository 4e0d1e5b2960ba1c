#pragma once

#include "cli/compare/light.h"
#include "cli/scene/scene_options.h"

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

using TellLook = std::function<void(std::uint32_t samples, const LightVerdict &verdict)>;

// Compares after 16 samples and at each doubling, up to the scene's number or 65536. Throws Failure.
LightVerdict compare_kernels(const KernelTask &task, const TellLook &told);

} // namespace cli
