// Reads particles from a file: LAMMPS dumps, XYZ and extended XYZ, PLY, CSV and TSV, NPY and NPZ; plain, gzip or zstd.
#pragma once

#include "cli/base/exit_code.h"
#include "cli/data/particles.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cli {

struct ParticleQuery {
    std::string format;      // of particle_formats; empty: known by the file's first bytes, or else by its name
    std::int64_t frame = -1; // 0 is the first of the file; -1 the last, -2 the one before
    // Read beside the positions, in this order and by these names; an error where the file lacks one. x, y and z are
    // the position. Case counts only where names differ in nothing else. "type" is also what a file has as element or
    // species.
    std::vector<std::string> columns;
    std::vector<std::string> if_present; // read where the file has them
    // Conditions "column < number" (<, <=, >, >=, ==, !=) or, of types that are words, "element == O" (==, !=): all
    // hold for what is kept.
    std::vector<std::string> where;
    ExitCode blame = ExitCode::usage; // of a condition that is none, and of columns that the file lacks
};

// A column that the file lacks.
struct UnknownColumn : Failure {
    UnknownColumn(ExitCode code, const std::string &message, std::string column) :
        Failure(code, message),
        name(std::move(column)) {}

    std::string name;
};

inline constexpr std::array<std::string_view, 7> particle_formats{"lammps", "xyz", "ply", "csv", "tsv", "npy", "npz"};

// The path - is standard input, of which frames other than the last are counted from the first, and which cannot be
// NPZ. Throws Failure: ExitCode::file if the file cannot be read at all; ExitCode::scene, with the file and the line or
// the byte, if it is not what it claims to be, holds numbers that are not finite or has no such frame.
Particles read_particles(const std::string &path, const ParticleQuery &query);

} // namespace cli
