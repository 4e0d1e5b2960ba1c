// Reads particles from a file: LAMMPS dumps, XYZ and extended XYZ, PLY, CSV and TSV, NPY and NPZ; plain, gzip or zstd.
#pragma once

#include "cli/data/particles.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct ParticleQuery {
    std::string format;                  // of those above, as `--data-format` has them; empty: by the name of the file
    std::int64_t frame = -1;             // 0 is the first of the file; -1 the last, -2 the one before
    std::vector<std::string> columns;    // read beside the positions; an error where the file lacks one
    std::vector<std::string> if_present; // read where the file has them
    std::vector<std::string> where;      // conditions "column < number" (<, <=, >, >=, ==, !=): all hold for what is kept
};

// Throws Failure, which names the file and the line or the byte, if the file cannot be read as what it claims to be.
Particles read_particles(const std::string &path, const ParticleQuery &query);

} // namespace cli
