// Rows of particles as text has them: a line each, columns separated by blanks.
#pragma once

#include "cli/data/data_stream.h"
#include "cli/data/particle_rows.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// What is separated by blanks.
std::vector<std::string> split_at_blanks(std::string_view line);

// All numbers of the line. Throws Failure, with the place of the stream's last line, if something else is in it.
std::vector<double> read_line_numbers(const DataStream &stream, std::string_view line);

// The whole number that the line consists of. what: for messages, "the number of atoms".
std::uint64_t read_line_count(const DataStream &stream, std::string_view line, const std::string &what);

struct TextTable {
    std::uint64_t row_count;
    std::size_t column_count;
    bool may_have_more; // columns, which are not looked at
    bool must_end; // the last line, as the programs that write such files have it, so that what is cut short is seen
};

// Both throw Failure where there are fewer lines; the first also for lines that are not as they should be.
void read_rows(DataStream &stream, const TextTable &table, ParticleRows &rows);
void skip_rows(DataStream &stream, std::uint64_t row_count);

} // namespace cli
