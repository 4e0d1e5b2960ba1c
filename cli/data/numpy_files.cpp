#include "cli/data/numpy_files.h"

#include "cli/base/exit_code.h"
#include "cli/data/array_columns.h"
#include "cli/data/npy_header.h"
#include "cli/data/zip_file.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace cli {
namespace {

constexpr std::string_view npy_suffix = ".npy";

constexpr std::array<PositionNames, 4> numpy_positions{{{{"positions[0]", "positions[1]", "positions[2]"}},
                                                        {{"position[0]", "position[1]", "position[2]"}},
                                                        {{"pos[0]", "pos[1]", "pos[2]"}},
                                                        {{"x", "y", "z"}}}};

// Columns of a plain array: the first three are the position, the others are called by their index.
std::vector<std::string> plain_columns(const DataStream &stream, const NpyHeader &header) {
    if (header.shape.size() != 2 || header.shape[1] < 3 || header.fields.empty()) {
        throw Failure(ExitCode::scene, stream.name() +
                                           ": must be an array of numbers with the shape (n, 3), or with more "
                                           "columns, or of records with x, y and z");
    }
    std::vector<std::string> columns{"x", "y", "z"};
    for (std::uint64_t i = 3; i < header.shape[1]; ++i) {
        columns.push_back(std::to_string(i));
    }
    return columns;
}

struct NamedArray {
    std::string name;
    ParticleArray array;
};

std::unique_ptr<DataStream> open_member_stream(const std::string &path, const ZipMember &member) {
    return std::make_unique<DataStream>(path + ": " + member.name, open_member(path, member));
}

// Arrays of shapes or types that are no columns of particles may stand beside them.
std::optional<NamedArray> array_of(const std::string &path, const ZipMember &member) {
    if (!member.name.ends_with(npy_suffix)) {
        return std::nullopt;
    }
    const std::string name = member.name.substr(0, member.name.size() - npy_suffix.size());
    const auto stream = open_member_stream(path, member);
    NpyHeader header = read_npy_header(*stream);
    if (header.fields.empty() || header.is_structured || header.shape.empty() || header.shape.size() > 2) {
        return std::nullopt;
    }
    NamedArray found{name, particle_array(*stream, std::move(header), name)};
    found.array.open = [path, member] {
        auto opened = open_member_stream(path, member);
        read_npy_header(*opened);
        return opened;
    };
    return found;
}

bool has_positions(const NamedArray &candidate) {
    return std::any_of(numpy_positions.begin(), numpy_positions.end(), [&candidate](const PositionNames &position) {
        const std::vector<std::string> &columns = candidate.array.columns;
        return std::find(columns.begin(), columns.end(), position.names[0]) != columns.end();
    });
}

} // namespace

void read_npy(const std::string &path, std::unique_ptr<DataStream> stream, ParticleRows &rows) {
    NpyHeader header = read_npy_header(*stream);
    std::array<ParticleArray, 1> arrays{particle_array(*stream, std::move(header), "x")};
    if (!arrays[0].header.is_structured) {
        arrays[0].columns = plain_columns(*stream, arrays[0].header);
    }
    arrays[0].begun = std::move(stream);
    arrays[0].open = [&path] {
        if (!is_regular_file(path)) {
            throw Failure(ExitCode::scene, path + ": an array in Fortran order has to be a file");
        }
        auto opened = std::make_unique<DataStream>(path, open_bytes(path));
        read_npy_header(*opened);
        return opened;
    };
    read_arrays(path, arrays, numpy_positions, rows);
}

void read_npz(const std::string &path, ParticleRows &rows) {
    std::vector<NamedArray> found;
    std::size_t column_count = 0;
    for (const ZipMember &member : read_zip_directory(path)) {
        if (auto array = array_of(path, member)) {
            column_count += array->array.columns.size();
            if (column_count > ParticleRows::most_columns) {
                throw Failure(ExitCode::scene, path + ": there are more than " +
                                                   std::to_string(ParticleRows::most_columns) +
                                                   " columns in all arrays together");
            }
            found.push_back(std::move(*array));
        }
    }
    const auto position = std::find_if(found.begin(), found.end(), has_positions);
    if (position == found.end()) {
        throw Failure(ExitCode::scene, path +
                                           ": must have an array positions.npy with the shape (n, 3), or x.npy, y.npy "
                                           "and z.npy");
    }
    const std::uint64_t count = position->array.count;
    std::vector<ParticleArray> arrays;
    for (NamedArray &each : found) {
        if (each.array.count == count) {
            arrays.push_back(std::move(each.array));
        }
    }
    read_arrays(path, arrays, numpy_positions, rows);
}

} // namespace cli
