#include "cli/data/ply_header.h"

#include "cli/base/exit_code.h"
#include "cli/data/text_number.h"
#include "cli/data/text_rows.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace cli {
namespace {

struct TypeName {
    std::string_view name;
    NumberType type;
};

constexpr std::array<TypeName, 16> ply_types{{{"char", NumberType::int8},
                                              {"uchar", NumberType::uint8},
                                              {"short", NumberType::int16},
                                              {"ushort", NumberType::uint16},
                                              {"int", NumberType::int32},
                                              {"uint", NumberType::uint32},
                                              {"float", NumberType::float32},
                                              {"double", NumberType::float64},
                                              {"int8", NumberType::int8},
                                              {"uint8", NumberType::uint8},
                                              {"int16", NumberType::int16},
                                              {"uint16", NumberType::uint16},
                                              {"int32", NumberType::int32},
                                              {"uint32", NumberType::uint32},
                                              {"float32", NumberType::float32},
                                              {"float64", NumberType::float64}}};

class PlyHeaderReader {
public:
    explicit PlyHeaderReader(DataStream &stream) : stream_(stream) {}

    PlyHeader read() {
        if (require_line() != "ply") {
            refuse("must begin with a line \"ply\"");
        }
        for (;;) {
            const std::string_view line = require_line();
            const std::vector<std::string> words = split_at_blanks(line);
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
                continue;
            }
            if (words[0] == "end_header") {
                break;
            }
            read_words(words, line);
        }
        if (!has_format_) {
            refuse("there is no line \"format\" in the head");
        }
        return std::move(header_);
    }

private:
    [[noreturn]] void refuse(const std::string &what) const {
        throw Failure(ExitCode::scene, stream_.line_place() + ": " + what);
    }

    std::string_view require_line() {
        std::string_view line;
        if (!stream_.next_line(line) || !stream_.was_line_ended()) {
            refuse("the file ends within its head: it was cut short");
        }
        return line;
    }

    void read_words(const std::vector<std::string> &words, std::string_view line) {
        const std::string quoted = quoted_text(line);
        if (words[0] == "format" && words.size() == 3 && words[2] == "1.0") {
            read_format(words[1]);
        } else if (words[0] == "element" && words.size() == 3) {
            header_.elements.push_back({words[1], read_line_count(stream_, words[2], "the number of elements"), {}});
        } else if (words[0] == "property" && words.size() == 3 && !header_.elements.empty()) {
            header_.elements.back().properties.push_back({words[2], type_of(words[1]), std::nullopt});
        } else if (words[0] == "property" && words.size() == 5 && words[1] == "list" && !header_.elements.empty()) {
            const NumberType count_type = type_of(words[2]);
            if (count_type == NumberType::float32 || count_type == NumberType::float64) {
                refuse(quoted + ": the number of a list's values must be of a whole type");
            }
            header_.elements.back().properties.push_back({words[4], type_of(words[3]), count_type});
        } else {
            refuse("\"" + quoted + "\" is no line of a head");
        }
    }

    void read_format(const std::string &name) {
        if (name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian") {
            refuse("format " + quoted_text(name) + ": must be ascii, binary_little_endian or binary_big_endian");
        }
        header_.format = name == "ascii"                  ? PlyFormat::ascii
                         : name == "binary_little_endian" ? PlyFormat::little_endian
                                                          : PlyFormat::big_endian;
        has_format_ = true;
    }

    NumberType type_of(const std::string &name) const {
        const auto *found = std::find_if(ply_types.begin(), ply_types.end(),
                                         [&name](const TypeName &each) { return each.name == name; });
        if (found == ply_types.end()) {
            refuse("type " + quoted_text(name) +
                   ": must be one of char, uchar, short, ushort, int, uint, float and double");
        }
        return found->type;
    }

    DataStream &stream_;
    PlyHeader header_{};
    bool has_format_ = false;
};

} // namespace

bool PlyElement::has_lists() const {
    return std::any_of(properties.begin(), properties.end(), [](const PlyProperty &each) { return each.count_type; });
}

PlyHeader read_ply_header(DataStream &stream) {
    return PlyHeaderReader(stream).read();
}

} // namespace cli
