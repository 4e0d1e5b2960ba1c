// The section `figure` of a scene file, by which camera and light follow from its particles.
#pragma once

#include "cli/base/json_value.h"
#include "cli/layout/figure_look.h"

namespace cli {

// Throws JsonRefusal.
void read_figure_item(FigureLook &look, const JsonPlace &place, const nlohmann::json &value);

} // namespace cli
