// Rows of particles as binary files have them: records of equal size, in one stream or, where every column is kept for
// itself, in several that are read in step.
#pragma once

#include "cli/data/data_stream.h"
#include "cli/data/number_type.h"
#include "cli/data/particle_rows.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cli {

struct RecordField {
    std::size_t offset; // from the begin of the record, in bytes
    NumberFormat format;
    std::uint32_t slot; // of the row
};

struct RecordStream {
    std::unique_ptr<DataStream> stream; // where the first record begins
    std::size_t record_size;            // in bytes
    std::vector<RecordField> fields;
};

// Throws Failure where a stream ends before it has so many records, where records are larger than DataStream::longest,
// and as ParticleRows does.
void read_records(std::span<const RecordStream> streams, std::uint64_t count, ParticleRows &rows);

[[noreturn]] void refuse_missing_records(const DataStream &stream, std::uint64_t count, std::uint64_t expected);

} // namespace cli
