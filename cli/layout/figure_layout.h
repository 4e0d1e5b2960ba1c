// Everything about a figure that follows from its balls: the camera, the light, the size of the picture.
#pragma once

#include "cli/base/number.h"
#include "cli/data/particles.h"
#include "cli/layout/balls.h"
#include "cli/layout/figure_look.h"

#include <optional>

namespace cli {

struct FigureLayout {
    ImageSize size;
    FittedCamera camera;
    Stage stage;
};

// size: of the picture; nothing: as the balls are. box: what is seen of it, if anything is. Throws
// std::invalid_argument for a floor that would be between the camera and the balls. There must be one ball.
FigureLayout lay_out(const FigureLook &look, const std::optional<ImageSize> &size, const Balls &balls,
                     const std::optional<SimulationBox> &box);

} // namespace cli
