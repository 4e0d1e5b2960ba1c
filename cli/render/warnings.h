// Warnings: what can be rendered but is surely not meant. Each is printed once on stderr, unless -q is given, and
// listed in the --stats file.
#pragma once

#include "cli/render/render_report.h"
#include "cli/scene/scene_file.h"

#include <span>
#include <string>
#include <vector>

namespace cli {

// Known before rendering: nothing emits, materials that give off more light than they receive, a
// target error of 100% or more (0: none).
std::vector<std::string> input_warnings(const SceneFile &scene, double target_error);

// Known of the image: samples left out, a channel at its maximum in more than a quarter of the pixels of a tone-mapped
// picture, and black throughout where the scene did not tell. report.warnings: those from before rendering.
std::vector<std::string> image_warnings(const RenderReport &report, std::span<const float> radiance);

void print_warnings(std::span<const std::string> warnings);

} // namespace cli
