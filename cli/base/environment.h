// What the program takes from its environment, and adds to it: the folder of its cache, the width of the vectors for
// which Mesa's llvmpipe compiles the kernel, and the date in the metadata of images.
#pragma once

#include <filesystem>
#include <string>

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

// "2001:09:09 01:46:40", the form of DateTime in TIFF and of capDate in OpenEXR, in UTC; empty without that variable.
// Throws Failure(ExitCode::usage) if it is not such a number, as the specification asks.
std::string source_date();

} // namespace cli
