#pragma once

#include <filesystem>

namespace cli {

// Empty without a home directory. The folder may not exist.
std::filesystem::path user_cache();

// Asks llvmpipe for vectors of 512 bits, unless the user chose a width. Must run before other threads.
void widen_vectors();

// Calls widen_vectors() if the CPU has AVX-512. Must precede the first Vulkan instance.
void choose_vector_width();

} // namespace cli
