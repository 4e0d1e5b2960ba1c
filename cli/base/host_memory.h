// Checks before a rendering whether its images fit into the memory of this process.
#pragma once

#include "cli/scene/render_settings.h"

#include <cstdint>
#include <string>

namespace cli {

// Size of so many images of radiance, or of its standard error, of a window.
std::uint64_t image_bytes(const ImageWindow &window, std::uint32_t image_count);

// Throws Failure if they take more than the process can ever have, and blames who gave the size: the command line, or
// the scene file of that path.
void require_host_memory(const RenderSettings &settings, const std::string &scene, std::uint32_t image_count);

} // namespace cli
