// Denoising a picture from two halves of its samples: `pt render --denoise` and `pt denoise`.
#pragma once

#include "cli/render/picture_layer.h"

#include <span>
#include <string>

namespace cli {

// Throws Failure(ExitCode::file), and says what installs it, unless the library can denoise.
void require_denoiser(const std::string &library);

// The denoised picture of two halves of equally many samples, with the mean of both as `raw`, the sum of their counts,
// and the layers of the second. albedo, normal: three numbers a pixel. Throws Failure.
RenderedImage denoised(const std::string &library, const RenderedImage &first, RenderedImage second,
                       std::span<const float> albedo, std::span<const float> normal);

} // namespace cli
