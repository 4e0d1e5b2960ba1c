// Tables as text: CSV (RFC 4180, but for line breaks within quotes) and TSV, with the names of columns in the first
// line.
#pragma once

#include "cli/data/data_stream.h"
#include "cli/data/particle_rows.h"

namespace cli {

// A semicolon separates where a first line has one and no comma, as spreadsheets have it in many countries. Throws
// Failure.
void read_csv(DataStream &stream, ParticleRows &rows);
void read_tsv(DataStream &stream, ParticleRows &rows);

} // namespace cli
