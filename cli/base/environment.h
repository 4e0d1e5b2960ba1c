// The cache folder, and the vector width for which Mesa's llvmpipe compiles.
#pragma once

#include <filesystem>

namespace cli {

// The program's cache folder, which need not exist. Empty without a home directory.
std::filesystem::path user_cache();

// Asks llvmpipe for vectors of 512 bits, unless the user has chosen a width, with a cache of their own: lists of
// spheres are up to 1.7 times as fast. Not while other threads run: the environment has no lock.
void widen_vectors();

// With AVX-512 only; before an instance is created.
void choose_vector_width();

} // namespace cli
