#pragma once

#include <pt/denoise.h>

namespace pt {

// Filters info.first and info.second separately. Throws PT_ERROR_UNSUPPORTED if the library cannot be loaded.
void run_open_image_denoise(const pt_denoise_info &info, float *first_filtered, float *second_filtered);

} // namespace pt
