// Arrays of NumPy as columns of particles: those of an NPY file, or of the members of an NPZ file.
#pragma once

#include "cli/data/data_stream.h"
#include "cli/data/npy_header.h"
#include "cli/data/particle_rows.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cli {

struct ParticleArray {
    NpyHeader header;
    std::uint64_t count;               // of particles: the first length of the shape
    std::vector<std::string> columns;  // names of its numbers for a particle
    std::unique_ptr<DataStream> begun; // behind the head; nullptr: opened anew
    // A stream that stands behind the head. Where columns are kept one after the other each needs its own; throws
    // Failure where the file cannot be opened again.
    std::function<std::unique_ptr<DataStream>()> open;
};

// Of one or two lengths; each element has its name or, in a second length, an index: "velocity[2]". Throws Failure for
// other shapes.
ParticleArray particle_array(const DataStream &stream, NpyHeader header, const std::string &name);

// Reads the particles of arrays that have equally many, which are the columns of all of them. Throws Failure.
void read_arrays(const std::string &file, std::span<ParticleArray> arrays, std::span<const PositionNames> positions,
                 ParticleRows &rows);

} // namespace cli
