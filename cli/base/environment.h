// Folders and variables of the environment.
#pragma once

#include <filesystem>

namespace cli {

// Need not exist. Empty without a home directory.
std::filesystem::path user_cache();

// Asks llvmpipe for vectors of 512 bits, unless the user chose a width. Not while other threads run.
void widen_vectors();

// Does so with AVX-512 only. Call before an instance is created.
void choose_vector_width();

} // namespace cli
