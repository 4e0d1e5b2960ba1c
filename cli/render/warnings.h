// Warnings about valid input that is surely not intended. Printed on stderr and listed in --stats.
#pragma once

#include "cli/render/render_report.h"
#include "cli/scene/scene_file.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {

// Warnings before rendering: no lamp, materials that brighten light, a target error from 100% on (0: none). of_library:
// about the view.
std::vector<std::string> input_warnings(const SceneFile &scene, const std::optional<BrokenRule> &of_library,
                                        double target_error);

// Warnings after rendering: samples left out, a picture far darker than its target error, an unexplained black picture.
std::vector<std::string> image_warnings(const RenderReport &report, std::span<const float> radiance);

void print_warnings(std::span<const std::string> warnings);

} // namespace cli
