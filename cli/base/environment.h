// What the program takes from its environment, and adds to it: the folder of its cache, and the width of the vectors
// for which Mesa's llvmpipe compiles the kernel.
#pragma once

#include <filesystem>

namespace cli {

// The program's part of the user's cache folder, which need not exist. Empty without a home directory.
std::filesystem::path user_cache();

// Asks llvmpipe for vectors of 512 bits, unless the user has chosen a width, and says where shaders compiled for it are
// kept, or that none are. Clouds of 8 / 14 / 30 / 64 / 120 spheres over a floor have 1.3 / 1.7 / 1.4 / 1.7 / 1.6 times
// the speed that they have with llvmpipe's own choice, 256, at path length 3; in a tree, from 113 on, 1.05 to 1.15
// times, at path length 6 0.99 to 1.1 times. Not while other threads run: the environment has no lock.
void widen_vectors();

// The same on a machine with AVX-512. The driver reads its environment when an instance is created.
void choose_vector_width();

} // namespace cli
