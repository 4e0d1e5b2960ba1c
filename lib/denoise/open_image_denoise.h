// Open Image Denoise, loaded on demand: this library does not link it, and works without it.
#pragma once

#include <cstddef>
#include <span>

namespace pt {

// Images of R, G, B (x, y, z) as float32, row by row without gaps. The guides are without noise.
struct Guides {
    std::size_t width;
    std::size_t height;
    const float *albedo;
    const float *normal;
};

struct FilterTask {
    const float *radiance; // linear, without bounds
    float *filtered;
};

struct Denoiser {
    const char *path; // of the library; NULL: where the system finds it
    bool any_device;  // the library's choice, instead of the CPU
};

// Filters images, each by itself. Throws PT_ERROR_UNSUPPORTED where the library is not there.
void run_open_image_denoise(const Denoiser &denoiser, const Guides &guides, std::span<const FilterTask> tasks);

} // namespace pt
