#pragma once

#include "cli/picture/picture_layer.h"

#include <span>
#include <string>

namespace cli {

// Throws Failure(ExitCode::file), with advice on installation, if the library does not work.
void require_denoiser(const std::string &library);

// The halves must have equally many samples. The result has their mean as `raw`, the sum of their counts, and the
// layers of the second half. Throws Failure.
RenderedImage denoised(const std::string &library, const RenderedImage &first, RenderedImage second,
                       std::span<const float> albedo, std::span<const float> normal);

} // namespace cli
