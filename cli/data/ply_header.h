// The head of a PLY file: which elements it has, and what each consists of.
#pragma once

#include "cli/data/data_stream.h"
#include "cli/data/number_type.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

enum class PlyFormat { ascii, little_endian, big_endian };

struct PlyProperty {
    std::string name;
    NumberType type;
    std::optional<NumberType> count_type; // of a list, before whose values their number stands
};

struct PlyElement {
    std::string name;
    std::uint64_t count;
    std::vector<PlyProperty> properties;

    bool has_lists() const;
};

struct PlyHeader {
    PlyFormat format;
    std::vector<PlyElement> elements; // in the order of the file
};

// Takes the head from the stream. Throws Failure.
PlyHeader read_ply_header(DataStream &stream);

} // namespace cli
