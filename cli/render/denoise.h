// The option --denoise of `pt render`: a picture is denoised from two halves of its samples.
#pragma once

#include "cli/render/picture_layer.h"
#include "cli/render/render_options.h"

#include <string>

namespace cli {

// Throws Failure(ExitCode::file), and says what installs it, unless the library can denoise.
void require_denoiser(const std::string &library);

// The denoised picture of two halves of equally many samples; the second has the guides, albedo and normal. Keeps the
// layers that the options ask for, and the mean of both as `raw`. Throws Failure.
RenderedImage denoised(const RenderOptions &options, const RenderedImage &first, RenderedImage second);

} // namespace cli
