// Particles in NPY files, arrays of (n, 3) or more numbers or of records with x, y and z, and in NPZ files, which have
// an array "positions" or three arrays "x", "y" and "z".
#pragma once

#include "cli/data/data_stream.h"
#include "cli/data/particle_rows.h"

#include <memory>
#include <string>

namespace cli {

// stream: where the file begins; path: of the file. Throw Failure.
void read_npy(const std::string &path, std::unique_ptr<DataStream> stream, ParticleRows &rows);
void read_npz(const std::string &path, ParticleRows &rows);

} // namespace cli
