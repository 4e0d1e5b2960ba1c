// Warnings about valid input that is probably not intended, printed on stderr and listed in --stats.
#pragma once

#include "cli/render/render_report.h"
#include "cli/scene/scene_file.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {

// Warns about missing lamps, materials that brighten light, and a target error of at least 100% (0: none). of_library:
// the library's warning about the view.
std::vector<std::string> input_warnings(const SceneFile &scene, const std::optional<BrokenRule> &of_library,
                                        double target_error);

// Warns about rejected samples, a picture far darker than its target error, and an unexplained black picture.
std::vector<std::string> image_warnings(const RenderReport &report, std::span<const float> radiance);

void print_warnings(std::span<const std::string> warnings);

} // namespace cli
