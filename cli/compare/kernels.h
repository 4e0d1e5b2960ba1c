#pragma once

#include "cli/base/context.h"
#include "cli/compare/light.h"
#include "cli/scene/scene.h"
#include "cli/scene/scene_options.h"

#include <cstdint>
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

// Compares after 16 samples and after each doubling, up to the scene's spp, or 65536 without spp. Throws Failure.
LightVerdict compare_kernels(const KernelTask &task, const TellLook &told);

// Compares two contexts in this way, up to `most` samples. The scene must not have files of columns.
LightVerdict compare_kernels(const Context &edited, const Context &built_in, const SceneFile &scene, std::uint32_t most,
                             const LightRule &rule, const TellLook &told);

} // namespace cli
