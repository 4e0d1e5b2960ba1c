// Puts a rendered figure before its background, and lines over it.
#pragma once

#include "cli/figure/overlay.h"
#include "cli/image/tone_map.h"

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace cli {

enum class FigureBackground { white, transparent };

inline constexpr std::array<std::string_view, 2> figure_background_names{"white", "transparent"};

std::optional<FigureBackground> find_figure_background(std::string_view name);

struct ComposedFigure {
    std::vector<float> light; // of the display, R, G, B in [0, 1], linear; multiplied by alpha where there is one
    std::vector<float> alpha; // of a transparent background; else empty
};

// radiance: of the whole scene. stage: of the same scene without its particles, by the same samples; three components
// to a pixel, or three alone if all pixels are alike.
//
// What the particles and their shadows change is carried over to the background, as Debevec does where photographs are
// the background (1998, "Rendering Synthetic Objects into Real Scenes", section 5): with the particles' share a of a
// pixel it is
//
//     light = T(radiance) + (1 - a) (white - T(stage)),
//
// T being the tone map. So a floor is white where nothing darkens it, and its shadows fade with the distance in which
// the lamp does, without a horizon; without a floor T(radiance) is T(stage) where nothing is, and the background is
// white to the last bit. Transparent, alpha is the least that gives this light over white: the particles' share at
// least, and of a shadow how much it darkens.
ComposedFigure compose(std::span<const float> radiance, std::span<const float> stage, const Overlay &overlay,
                       const ToneMap &tone_map, FigureBackground background);

} // namespace cli
