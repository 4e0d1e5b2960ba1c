// Renders a figure: its radiance, that of its stage alone, and what is laid over it.
#pragma once

#include "cli/base/context.h"
#include "cli/base/progress.h"
#include "cli/figure/overlay.h"
#include "cli/layout/stage.h"
#include "cli/render/piecewise_render.h"
#include "cli/scene/render_settings.h"
#include "cli/scene/scene_file.h"

#include <functional>
#include <span>
#include <vector>

namespace cli {

// What a figure shows, and how its scene counts it: the spheres of the stage, then the particles, then the floor.
struct FigureContents {
    const Balls &balls;
    ParticleObjects objects;
    FittedCamera camera;
    std::span<const Segment> lines;
    double line_width; // pixels
    bool has_outlines;
};

// The scene is described, and the render settings are set (fit_pieces). All throw Failure.
//
// Reads what the camera sees first, in bands of rows: they take the place of the render settings of the context.
Overlay read_overlay(const Context &context, const FigureContents &contents, const RenderSettings &settings);

// The radiance without the particles: three numbers where nothing but the surround is there, else an image, rendered by
// the same samples.
std::vector<float> render_stage(const Context &context, const SceneFile &scene, const RenderSettings &settings,
                                const Stage &stage, std::uint32_t sample_count);

} // namespace cli
