// Chooses the width of the vectors for which Mesa's llvmpipe compiles the kernel. The driver reads its environment when
// an instance is created, so every command does this first.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace cli {

using Environment = std::map<std::string, std::string>;

// Of this process.
Environment own_environment();

// The program's part of it, which need not exist. Empty if there is none: without a home directory.
std::filesystem::path user_cache(const Environment &environment);

// The variables to add to an environment on a machine with AVX-512: the width, unless the user has chosen one, and
// where shaders compiled for it are kept, or that none are. Clouds of 8 / 14 / 30 / 64 / 120 spheres over a floor
// have 1.3 / 1.7 / 1.4 / 1.7 / 1.6 times the speed with vectors of 512 bits that they have with llvmpipe's own choice,
// 256, at path length 3; in a tree, from 113 on, 1.05 to 1.15 times, at path length 6 0.99 to 1.1 times.
Environment wide_vectors(const Environment &environment);

// Adds them to the environment of this process, if the machine has AVX-512. Not while other threads run: the
// environment has no lock.
void choose_vector_width();

} // namespace cli
