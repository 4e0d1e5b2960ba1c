#include "cli/data/array_columns.h"

#include "cli/base/exit_code.h"
#include "cli/data/column_name.h"
#include "cli/data/record_rows.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace cli {
namespace {

// More do not fit any file, and products of sizes cannot overflow.
constexpr std::uint64_t most_particles = std::uint64_t{1} << 40;

std::string shape_text(const std::vector<std::uint64_t> &shape) {
    std::string text = "(";
    for (const std::uint64_t length : shape) {
        text += (text.size() == 1 ? "" : ", ") + std::to_string(length);
    }
    return text + (shape.size() == 1 ? ",)" : ")");
}

std::uint64_t component_count(const NpyHeader &header) {
    return header.shape.size() == 2 ? header.shape[1] : 1;
}

std::unique_ptr<DataStream> stream_of(ParticleArray &array) {
    return array.begun ? std::move(array.begun) : array.open();
}

// All that is read of an array whose particles are one after the other.
RecordStream records_by_particle(ParticleArray &array, std::span<const std::uint32_t> slots) {
    const std::size_t size = array.header.element_size;
    RecordStream records{stream_of(array), size * static_cast<std::size_t>(component_count(array.header)), {}};
    for (std::size_t column = 0; column < slots.size(); ++column) {
        if (slots[column] == ParticleRows::unused) {
            continue;
        }
        const NpyField &field = array.header.fields[array.header.is_structured ? column : 0];
        const std::size_t first = array.header.is_structured ? 0 : column * size;
        records.fields.push_back({first + field.offset, field.format, slots[column]});
    }
    return records;
}

void add_records_by_column(std::vector<RecordStream> &streams, ParticleArray &array,
                           std::span<const std::uint32_t> slots) {
    const std::size_t size = array.header.element_size;
    for (std::size_t column = 0; column < slots.size(); ++column) {
        if (slots[column] == ParticleRows::unused) {
            continue;
        }
        RecordStream records{stream_of(array), size, {{0, array.header.fields[0].format, slots[column]}}};
        const std::uint64_t before = column * array.count * size;
        if (records.stream->skip(before) < before) {
            refuse_missing_records(*records.stream, 0, array.count);
        }
        streams.push_back(std::move(records));
    }
}

} // namespace

ParticleArray particle_array(const DataStream &stream, NpyHeader header, const std::string &name) {
    const std::size_t most_lengths = header.is_structured ? 1 : 2;
    if (header.shape.empty() || header.shape.size() > most_lengths || header.shape[0] > most_particles ||
        component_count(header) > ParticleRows::most_columns) {
        throw Failure(ExitCode::scene, stream.name() + ": the shape " + shape_text(header.shape) +
                                           ": must be (n,) or, of plain numbers, (n, k) with k up to " +
                                           std::to_string(ParticleRows::most_columns));
    }
    ParticleArray array{std::move(header), 0, {}, nullptr, {}};
    array.count = array.header.shape[0];
    if (array.header.is_structured) {
        for (const NpyField &field : array.header.fields) {
            array.columns.push_back(field.name);
        }
    } else if (!array.header.fields.empty()) {
        for (std::uint64_t i = 0; i < component_count(array.header); ++i) {
            array.columns.push_back(array.header.shape.size() == 1 ? name : component_name(name, i));
        }
    }
    return array;
}

void read_arrays(const std::string &file, std::span<ParticleArray> arrays, std::span<const PositionNames> positions,
                 ParticleRows &rows) {
    std::vector<std::string> columns;
    for (const ParticleArray &array : arrays) {
        columns.insert(columns.end(), array.columns.begin(), array.columns.end());
    }
    rows.set_place([&file](std::uint32_t) { return file; });
    rows.begin_frame(columns, positions, std::nullopt);
    std::vector<RecordStream> streams;
    std::size_t first = 0;
    for (ParticleArray &array : arrays) {
        const auto slots = rows.slots().subspan(first, array.columns.size());
        first += array.columns.size();
        const bool is_used =
            std::any_of(slots.begin(), slots.end(), [](std::uint32_t slot) { return slot != ParticleRows::unused; });
        if (is_used && array.header.is_column_major && component_count(array.header) > 1) {
            add_records_by_column(streams, array, slots);
        } else if (is_used) {
            streams.push_back(records_by_particle(array, slots));
        }
    }
    read_records(streams, arrays.front().count, rows);
}

} // namespace cli
