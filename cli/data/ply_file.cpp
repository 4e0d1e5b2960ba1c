#include "cli/data/ply_file.h"

#include "cli/base/exit_code.h"
#include "cli/data/ply_header.h"
#include "cli/data/record_rows.h"
#include "cli/data/text_number.h"
#include "cli/data/text_rows.h"

#include <algorithm>
#include <array>
#include <utility>

namespace cli {
namespace {

constexpr std::array<PositionNames, 1> ply_positions{{{{"x", "y", "z"}}}};

// Rows of a vertex that has lists, or of what comes before it: these are read value by value.
class PlyValues {
public:
    PlyValues(DataStream &stream, bool is_big_endian) : stream_(stream), is_big_endian_(is_big_endian) {}

    // Stores a property for which there is a place in the row, and skips one for which there is none, like all lists.
    void read(const PlyProperty &property, double *place) {
        if (property.count_type) {
            const double count = number(*property.count_type);
            if (count < 0.0) {
                throw Failure(ExitCode::scene, stream_.byte_place() + ": " + property.name + ": a list of " +
                                                   std::to_string(static_cast<std::int64_t>(count)) + " values");
            }
            skip(static_cast<std::uint64_t>(count) * size_of(property.type));
        } else if (place == nullptr) {
            skip(size_of(property.type));
        } else {
            *place = number(property.type);
        }
    }

    void skip(std::uint64_t size) {
        if (stream_.skip(size) < size) {
            refuse_end();
        }
    }

private:
    [[noreturn]] void refuse_end() const {
        throw Failure(ExitCode::scene, stream_.byte_place() + ": the file ends within an element: it was cut short");
    }

    double number(NumberType type) {
        const std::string_view bytes = stream_.take(size_of(type));
        if (bytes.size() < size_of(type)) {
            refuse_end();
        }
        return read_binary_number(bytes.data(), {type, is_big_endian_});
    }

    DataStream &stream_;
    bool is_big_endian_;
};

std::size_t record_size(const PlyElement &element) {
    std::size_t size = 0;
    for (const PlyProperty &property : element.properties) {
        size += size_of(property.type);
    }
    return size;
}

// Columns are the properties that are no lists.
std::vector<std::string> column_names(const PlyElement &vertex) {
    std::vector<std::string> names;
    for (const PlyProperty &property : vertex.properties) {
        if (!property.count_type) {
            names.push_back(property.name);
        }
    }
    return names;
}

// A line that holds lists: their numbers of values say which words are those of columns.
void read_text_with_lists(DataStream &stream, const PlyElement &vertex, ParticleRows &rows) {
    std::vector<double> row(rows.row_size());
    std::string_view line;
    for (std::uint64_t i = 0; i < vertex.count; ++i) {
        if (!stream.next_line(line) || !stream.was_line_ended()) {
            refuse_missing_records(stream, i, vertex.count);
        }
        const std::vector<std::string> words = split_at_blanks(line);
        std::size_t word = 0;
        std::size_t column = 0;
        for (const PlyProperty &property : vertex.properties) {
            if (word >= words.size()) {
                throw Failure(ExitCode::scene,
                              stream.line_place() + ": " + quoted_text(line) + " has no " + property.name);
            }
            if (property.count_type) {
                const std::uint64_t count = read_line_count(stream, words[word], property.name);
                word += std::min<std::uint64_t>(count, words.size()) + 1;
                continue;
            }
            if (const std::uint32_t slot = rows.slots()[column++]; slot != ParticleRows::unused) {
                rows.set(row.data(), slot, words[word]);
            }
            ++word;
        }
        if (word != words.size()) {
            throw Failure(ExitCode::scene, stream.line_place() + ": " + quoted_text(line) + " has " +
                                               std::to_string(words.size()) + " values, must have " +
                                               std::to_string(word));
        }
        rows.add(row.data());
    }
}

void read_text(DataStream &stream, const PlyElement &vertex, ParticleRows &rows) {
    rows.set_place([&stream](std::uint32_t) { return stream.line_place(); });
    const std::vector<std::string> names = column_names(vertex);
    rows.begin_frame(names, ply_positions, std::nullopt);
    if (vertex.has_lists()) {
        read_text_with_lists(stream, vertex, rows);
    } else {
        read_rows(stream, {vertex.count, names.size(), false, true}, rows);
    }
}

void read_binary_with_lists(DataStream &stream, const PlyElement &vertex, bool is_big_endian, ParticleRows &rows) {
    std::vector<double> row(rows.row_size());
    PlyValues values(stream, is_big_endian);
    for (std::uint64_t i = 0; i < vertex.count; ++i) {
        std::size_t column = 0;
        for (const PlyProperty &property : vertex.properties) {
            const std::uint32_t slot = property.count_type ? ParticleRows::unused : rows.slots()[column++];
            values.read(property, slot == ParticleRows::unused ? nullptr : &row[slot]);
        }
        rows.require_finite(row.data());
        rows.add(row.data());
    }
}

void read_binary(std::unique_ptr<DataStream> stream, const PlyElement &vertex, bool is_big_endian, ParticleRows &rows) {
    const DataStream &file = *stream;
    rows.set_place([&file](std::uint32_t) { return file.byte_place(); });
    rows.begin_frame(column_names(vertex), ply_positions, std::nullopt);
    if (vertex.has_lists()) {
        read_binary_with_lists(*stream, vertex, is_big_endian, rows);
        return;
    }
    std::array<RecordStream, 1> records{};
    records[0].record_size = record_size(vertex);
    std::size_t offset = 0;
    for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
        const NumberType type = vertex.properties[i].type;
        if (rows.slots()[i] != ParticleRows::unused) {
            records[0].fields.push_back({offset, {type, is_big_endian}, rows.slots()[i]});
        }
        offset += size_of(type);
    }
    records[0].stream = std::move(stream);
    read_records(records, vertex.count, rows);
}

void skip_element(DataStream &stream, const PlyElement &element, PlyFormat format) {
    if (format == PlyFormat::ascii) {
        skip_rows(stream, element.count);
        return;
    }
    PlyValues values(stream, format == PlyFormat::big_endian);
    // Without properties there is nothing to skip, however many there are.
    for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
        for (const PlyProperty &property : element.properties) {
            values.read(property, nullptr);
        }
    }
}

} // namespace

void read_ply(std::unique_ptr<DataStream> stream, ParticleRows &rows) {
    const PlyHeader header = read_ply_header(*stream);
    for (const PlyElement &element : header.elements) {
        if (element.name != "vertex") {
            skip_element(*stream, element, header.format);
            continue;
        }
        if (header.format == PlyFormat::ascii) {
            read_text(*stream, element, rows);
        } else {
            read_binary(std::move(stream), element, header.format == PlyFormat::big_endian, rows);
        }
        return;
    }
    throw Failure(ExitCode::scene, stream->line_place() + ": there is no element \"vertex\"");
}

} // namespace cli
