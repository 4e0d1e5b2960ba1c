// Open Image Denoise, loaded on demand: this library does not link it, and works without it.
#pragma once

#include <pt/denoise.h>

namespace pt {

// Filters both images, each by itself, into memory of their size. Throws PT_ERROR_UNSUPPORTED where the library is not
// there.
void run_open_image_denoise(const pt_denoise_info &info, float *first_filtered, float *second_filtered);

} // namespace pt
