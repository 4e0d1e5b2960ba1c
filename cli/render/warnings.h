// Warnings about input that is valid but surely not intended. Printed once on stderr, unless -q is given, and listed in
// the --stats file.
#pragma once

#include "cli/render/render_report.h"
#include "cli/scene/scene_file.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {

// Known before rendering: nothing emits, materials that reflect more light than they receive, a target error of 100% or
// more (0: none). of_library: about what the camera sees.
std::vector<std::string> input_warnings(const SceneFile &scene, const std::optional<BrokenRule> &of_library,
                                        double target_error);

// Known from the image: samples left out, a picture so dark that any noise reaches its target error, an unexplained
// black picture. report.warnings: from before rendering.
std::vector<std::string> image_warnings(const RenderReport &report, std::span<const float> radiance);

void print_warnings(std::span<const std::string> warnings);

} // namespace cli
