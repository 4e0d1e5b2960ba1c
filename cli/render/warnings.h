// Warnings about valid input that is probably not intended.
#pragma once

#include "cli/picture/render_report.h"
#include "cli/scene/scene.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cli {

std::vector<std::string> input_warnings(const SceneFile &scene, const std::optional<BrokenRule> &of_library,
                                        double target_error);

std::vector<std::string> image_warnings(const RenderReport &report, std::span<const float> radiance);

void print_warnings(std::span<const std::string> warnings);

} // namespace cli
