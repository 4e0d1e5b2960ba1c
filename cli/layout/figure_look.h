// How particles are shown: the view and the light of `pt figure` and of scenes with a "figure".
#pragma once

#include "cli/layout/camera_fit.h"
#include "cli/layout/stage.h"
#include "cli/layout/view_frame.h"

namespace cli {

struct FigureLook {
    ViewDirection view{view_names.front(), {}};
    glm::dvec3 up{0.0, 0.0, 1.0};
    Projection projection = Projection::perspective;
    FigureStyle style = FigureStyle::matte;
    bool has_floor = false;
};

} // namespace cli
