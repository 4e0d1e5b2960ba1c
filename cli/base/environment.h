#pragma once

#include <filesystem>

namespace cli {

// Returns a folder that may not exist. Empty without a home directory.
std::filesystem::path user_cache();

// Asks llvmpipe for vectors of 512 bits, unless the user chose a width. No other thread may run.
void widen_vectors();

// Calls widen_vectors() if the CPU has AVX-512. Must precede the first Vulkan instance.
void choose_vector_width();

} // namespace cli
