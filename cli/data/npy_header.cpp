#include "cli/data/npy_header.h"

#include "cli/base/exit_code.h"
#include "cli/base/number.h"
#include "cli/data/column_name.h"
#include "cli/data/particle_rows.h"
#include "cli/data/python_literal.h"
#include "cli/data/text_number.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace cli {
namespace {

using LiteralKind = PythonLiteral::Kind;

struct TypeCode {
    std::string_view code; // NumPy's kind and size in bytes
    NumberType type;
};

constexpr std::array<TypeCode, 11> npy_types{{{"f4", NumberType::float32},
                                              {"f8", NumberType::float64},
                                              {"i1", NumberType::int8},
                                              {"i2", NumberType::int16},
                                              {"i4", NumberType::int32},
                                              {"i8", NumberType::int64},
                                              {"u1", NumberType::uint8},
                                              {"u2", NumberType::uint16},
                                              {"u4", NumberType::uint32},
                                              {"u8", NumberType::uint64},
                                              {"b1", NumberType::uint8}}};

// Elements are no larger, so that sums and products of sizes do not overflow.
constexpr std::uint64_t largest_element = std::uint64_t{1} << 30;

class NpyHeaderReader {
public:
    explicit NpyHeaderReader(DataStream &stream) : stream_(stream) {}

    NpyHeader read() {
        const std::string text = read_text();
        const auto literal = parse_python_literal(text);
        const PythonLiteral *type = literal ? literal->find("descr") : nullptr;
        const PythonLiteral *order = literal ? literal->find("fortran_order") : nullptr;
        const PythonLiteral *shape = literal ? literal->find("shape") : nullptr;
        if (type == nullptr || order == nullptr || shape == nullptr || order->kind != LiteralKind::boolean ||
            shape->kind != LiteralKind::sequence) {
            refuse(quoted_text(text) + ": must be a dictionary with descr, fortran_order and shape");
        }
        NpyHeader header{{}, 0, type->kind == LiteralKind::sequence, order->number != 0, {}};
        for (const PythonLiteral &length : shape->elements) {
            if (length.kind != LiteralKind::whole_number) {
                refuse("shape: must be whole numbers");
            }
            header.shape.push_back(length.number);
        }
        if (header.is_structured) {
            add_fields(header, *type);
        } else {
            add_numbers(header, type->text, {}, 1);
        }
        return header;
    }

private:
    [[noreturn]] void refuse(const std::string &what) const {
        throw Failure(ExitCode::scene, stream_.byte_place() + ": " + what);
    }

    std::string_view require(std::size_t size) {
        const std::string_view bytes = stream_.take(size);
        if (bytes.size() < size) {
            refuse("the file ends within its head: it was cut short");
        }
        return bytes;
    }

    std::string read_text() {
        constexpr std::size_t mark_size = 8; // \x93NUMPY and the version
        const std::string mark(require(mark_size));
        if (!mark.starts_with("\x93NUMPY")) {
            refuse("must begin with \\x93NUMPY");
        }
        const int version = mark[6];
        if (version < 1 || version > 3) {
            refuse("NPY version " + std::to_string(version) + ": must be 1, 2 or 3");
        }
        const NumberType size_type = version == 1 ? NumberType::uint16 : NumberType::uint32;
        const double size = read_binary_number(require(size_of(size_type)).data(), {size_type, false});
        if (size > static_cast<double>(DataStream::longest)) {
            refuse("a head of " + std::to_string(static_cast<std::uint64_t>(size)) + " bytes: may have " +
                   std::to_string(DataStream::longest));
        }
        return std::string(require(static_cast<std::size_t>(size)));
    }

    // Fields [(name, type), ...], of which some are subarrays (name, type, shape).
    void add_fields(NpyHeader &header, const PythonLiteral &fields) const {
        for (const PythonLiteral &field : fields.elements) {
            const bool is_field =
                field.kind == LiteralKind::sequence && (field.elements.size() == 2 || field.elements.size() == 3);
            if (!is_field || field.elements[1].kind != LiteralKind::text) {
                refuse("descr: fields must be (name, type) or (name, type, shape) with a plain type");
            }
            // A pair in place of a name is a title and the name.
            const PythonLiteral &name =
                field.elements[0].kind == LiteralKind::sequence && field.elements[0].elements.size() == 2
                    ? field.elements[0].elements[1]
                    : field.elements[0];
            std::uint64_t count = 1;
            if (field.elements.size() == 3) {
                count = count_of(field.elements[2]);
            }
            add_numbers(header, field.elements[1].text, name.text, count);
        }
    }

    std::uint64_t count_of(const PythonLiteral &shape) const {
        std::uint64_t count = 1;
        const std::span<const PythonLiteral> lengths =
            shape.kind == LiteralKind::sequence ? std::span(shape.elements) : std::span(&shape, 1);
        for (const PythonLiteral &length : lengths) {
            if (length.kind != LiteralKind::whole_number || length.number == 0 ||
                length.number > largest_element / count) {
                refuse("descr: the shape of a field must be whole numbers above 0");
            }
            count *= length.number;
        }
        return count;
    }

    // "<f8": order, kind and size.
    void add_numbers(NpyHeader &header, std::string_view code, const std::string &name, std::uint64_t count) const {
        constexpr std::uint64_t most_components = 1024;
        const bool has_order = !code.empty() && std::string_view("<>=|").find(code.front()) != std::string_view::npos;
        const std::string_view plain = code.substr(has_order ? 1 : 0);
        const bool is_native_big = std::endian::native == std::endian::big;
        const bool is_big_endian = has_order && (code.front() == '>' || (code.front() == '=' && is_native_big));
        const auto *found = std::find_if(npy_types.begin(), npy_types.end(),
                                         [plain](const TypeCode &each) { return each.code == plain; });
        const bool is_number = found != npy_types.end();
        const std::uint64_t size = is_number ? size_of(found->type) : size_without_numbers(plain);
        if (size > largest_element / count || header.element_size + size * count > largest_element) {
            refuse("descr: an element of more than " + std::to_string(largest_element) + " bytes");
        }
        if (header.fields.size() > ParticleRows::most_columns) {
            refuse("descr: there are more than " + std::to_string(ParticleRows::most_columns) + " numbers in a record");
        }
        for (std::uint64_t i = 0; is_number && count <= most_components && i < count; ++i) {
            header.fields.push_back({count == 1 ? name : component_name(name, i),
                                     header.element_size + i * size,
                                     {found->type, is_big_endian}});
        }
        header.element_size += size * count;
    }

    // Of what is no number that is read: texts, bytes, complex numbers and the like.
    std::uint64_t size_without_numbers(std::string_view plain) const {
        constexpr std::uint64_t bytes_of_character = 4; // UCS-4, of U
        const auto size = plain.empty() ? std::nullopt : parse_number<std::uint32_t>(plain.substr(1));
        if (!size || std::string_view("USVafcmMiu").find(plain.front()) == std::string_view::npos) {
            refuse("descr = " + quoted_text(plain) +
                   ": must be a type of numbers: f4, f8, b1, or i or u with 1, 2, 4 "
                   "or 8");
        }
        return *size * (plain.front() == 'U' ? bytes_of_character : 1);
    }

    DataStream &stream_;
};

} // namespace

NpyHeader read_npy_header(DataStream &stream) {
    return NpyHeaderReader(stream).read();
}

} // namespace cli
