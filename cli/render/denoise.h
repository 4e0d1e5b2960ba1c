// Denoising a picture from two halves of its samples: `pt render --denoise` and `pt denoise`.
#pragma once

#include "cli/render/picture_layer.h"

#include <span>
#include <string>

namespace cli {

// Throws Failure(ExitCode::file), and names what to install, unless the library can denoise.
void require_denoiser(const std::string &library);

// Denoises two halves of equally many samples. The result has their mean as `raw`, the sum of their counts, and the
// second one's layers. albedo, normal: three numbers a pixel. Throws Failure.
RenderedImage denoised(const std::string &library, const RenderedImage &first, RenderedImage second,
                       std::span<const float> albedo, std::span<const float> normal);

} // namespace cli
