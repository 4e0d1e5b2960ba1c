// Chooses the width of the vectors for which Mesa's llvmpipe compiles the kernel. The driver reads its environment when
// an instance is created, so every command does this first.
#pragma once

#include "cli/base/user_cache.h"

#include <cstddef>

namespace cli {

// The variables to add to an environment on a machine with AVX-512, for a scene of so many spheres and planes. None
// where llvmpipe's own choice, 256 bits, is the faster one, and where the user has chosen.
Environment wide_vectors(const Environment &environment, std::size_t surface_count);

// Adds them to the environment of this process, if the machine has AVX-512. Not while other threads run: the
// environment has no lock.
void choose_vector_width(std::size_t surface_count);

} // namespace cli
