#pragma once

#include "cli/picture/picture_layer.h"

#include <functional>
#include <span>
#include <string>

struct pt_rounds_info;

namespace cli {

// Throws Failure(ExitCode::file), with advice on installation, if the library does not work.
void require_denoiser(const std::string &library);

// Two images with equally many samples.
struct Halves {
    RenderedImage first;
    RenderedImage second;
    std::span<const float> albedo;
    std::span<const float> normal;
};

// Like pt_round_fn. To stop, returns false and leaves the halves unchanged. `error` is the last round's.
using RenderHalves = std::function<bool(std::uint32_t sample_count, const pt_error_estimate &error, Halves &halves)>;

struct Denoised {
    RenderedImage image; // `raw` is the halves' mean; counts are sums; layers are the second half's
    pt_result ended;
};

RenderedImage denoised(const std::string &library, Halves halves);

// Throws Failure.
Denoised denoised_rounds(const std::string &library, const Rectangle &part, pt_rounds_info rounds,
                         const RenderHalves &render);

} // namespace cli
