#include "lib/scene_file/sphere_columns.h"

#include "lib/base/struct_size.h"
#include "lib/scene_file/read_file.h"
#include "lib/scene_file/scene_keys.h"
#include "lib/scene_file/text.h"

#include <algorithm>
#include <bit>
#include <filesystem>
#include <limits>
#include <string_view>

namespace pt {
namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "NPY files are used as they are");

constexpr std::string_view magic = "\x93NUMPY";

std::uint32_t size_of(std::uint32_t type) {
    return type == PT_TYPE_FLOAT64 ? 8 : type == PT_TYPE_FLOAT32 ? 4 : 1;
}

// The header is a Python dictionary, {'descr': '<f4', 'fortran_order': False, 'shape': (10, 3), }. It differs from JSON
// in quotes, parentheses, capitals and the last comma. The result is discarded if the header is not like this.
json dictionary_of(std::string_view head) {
    constexpr std::string_view python = "'()FT";
    constexpr std::string_view in_json = "\"[]ft";
    std::string text;
    for (std::size_t i = 0; i < head.size(); ++i) {
        const std::size_t next = std::min(head.find_first_not_of(' ', i + 1), head.size());
        const bool is_last_comma =
            head[i] == ',' && next < head.size() && std::string_view(")]}").find(head[next]) != std::string_view::npos;
        const std::size_t kind = python.find(head[i]);
        if (!is_last_comma)
            text += kind == std::string_view::npos ? head[i] : in_json[kind];
    }
    return json::parse(text, nullptr, false);
}

class NpyHeader {
public:
    NpyHeader(platform::InputFile &file, const std::string &name) : name_(name) {
        constexpr std::size_t version_place = magic.size();
        constexpr std::size_t longest = 65535; // longest header of version 1
        const std::string start(file.first(version_place + 2 + sizeof(std::uint32_t)));
        if (!start.starts_with(magic) || start.size() < version_place + 2)
            refuse("is not an NPY file, which begins with \\x93NUMPY: write it by numpy.save");
        const int version = static_cast<unsigned char>(start[version_place]);
        if (version != 1 && version != 2)
            refuse("has NPY version " + std::to_string(version) + ", must be 1 or 2, of arrays without named fields");
        const std::size_t size_bytes = version == 1 ? 2 : 4;
        const std::size_t begin = version_place + 2 + size_bytes;
        std::size_t size = 0;
        for (std::size_t i = 0; i < size_bytes && version_place + 2 + i < start.size(); ++i)
            size |= std::size_t{static_cast<unsigned char>(start[version_place + 2 + i])} << (8 * i);
        if (file.size() < begin || file.size() - begin < size)
            refuse("ends within its header: it was cut short");
        if (size > longest)
            refuse(concat("has a header of ", size, " bytes, must have at most ", longest));
        head_ = dictionary_of(file.first(begin + size).substr(begin));
        end_ = begin + size;
    }

    NpyArray read() const {
        NpyArray array;
        array.first = end_;
        array.type = type();
        if (value_of("fortran_order") != false)
            refuse("is in column order: save numpy.ascontiguousarray(array)");
        const std::vector<std::size_t> shape = read_shape();
        if (shape.empty() || shape.size() > 2)
            refuse("has " + std::to_string(shape.size()) + " dimensions, must have 1 or 2");
        array.row_count = shape[0];
        array.row_length = shape.size() == 2 ? shape[1] : 0;
        if (shape.size() == 2 && (shape[1] == 0 || shape[1] > longest_row))
            refuse("has rows of " + std::to_string(shape[1]) + " numbers, must have 1 to 3");
        return array;
    }

    [[noreturn]] void refuse(const std::string &what) const {
        throw Error(PT_ERROR_INVALID_SCENE, name_ + ": " + what);
    }

private:
    static constexpr std::size_t longest_row = 3;

    const json &value_of(const char *key) const {
        const auto found = head_.is_object() ? head_.find(key) : head_.end();
        if (found == head_.end())
            refuse("its header has no " + std::string(key));
        return *found;
    }

    std::uint32_t type() const {
        const json &code = value_of("descr");
        if (code == "<f4")
            return PT_TYPE_FLOAT32;
        if (code == "<f8")
            return PT_TYPE_FLOAT64;
        if (code == "|u1")
            return PT_TYPE_SRGB8;
        refuse("has numbers of the type " +
               (code.is_string() && shown(code) != json_kind(code.type()) ? code.get<std::string>()
                                                                          : json_kind(code.type())) +
               ", must be <f4, <f8 or |u1: save array.astype(\"float32\")");
    }

    std::vector<std::size_t> read_shape() const {
        const json &shape = value_of("shape");
        if (!shape.is_array() ||
            !std::ranges::all_of(shape, [](const json &each) { return each.is_number_unsigned(); }))
            refuse("its header has an invalid shape");
        return shape.get<std::vector<std::size_t>>();
    }

    const std::string &name_;
    json head_;
    std::size_t end_ = 0;
};

std::size_t length_of(const SceneKey &key) {
    return key.rule.form == ValueRule::Form::number ? 1 : 3;
}

bool may_be_bytes(const SceneKey &key) {
    return key.rule.form == ValueRule::Form::color;
}

std::string path_of(const SceneFile &scene, const SphereColumn &column) {
    return (std::filesystem::path(scene.path).parent_path() / column.file).string();
}

template <typename AnyScene, typename Use>
void for_each_file(AnyScene &scene, Use use) {
    for (auto &each : scene.sphere_columns)
        for (auto &column : each.columns)
            if (!column.file.empty())
                use(each, column);
}

void check_fit(const SceneKey &key, const NpyArray &array, const NpyArray &centers, const std::string &path) {
    const auto refuse_to_have = [&](bool is_refused, const std::string &what) {
        if (is_refused)
            throw Error(PT_ERROR_INVALID_SCENE, path + ": has " + what);
    };
    const bool is_single = length_of(key) == 1;
    refuse_to_have(is_single ? array.row_length != 0 : array.row_length != length_of(key),
                   concat("the shape (", array.row_count, ",",
                          array.row_length == 0 ? "" : concat(" ", array.row_length), "), must be ",
                          is_single ? "(N,)" : "(N, 3)"));
    refuse_to_have(array.type == PT_TYPE_SRGB8 && !may_be_bytes(key),
                   "numbers of the type |u1, which only colors may have; must be <f4 or <f8");
    refuse_to_have(array.row_count > std::numeric_limits<std::uint32_t>::max(), "more than 4294967295 rows");
    refuse_to_have(array.row_count != centers.row_count,
                   concat(array.row_count, " rows, but the centers have ", centers.row_count));
}

} // namespace

std::uint32_t NpyArray::row_bytes() const {
    return size_of(type) * static_cast<std::uint32_t>(std::max<std::size_t>(row_length, 1));
}

NpyArray read_npy(platform::InputFile &file, const std::string &name) {
    const NpyHeader header(file, name);
    NpyArray array = header.read();
    const std::size_t bytes = file.size() - array.first;
    const std::size_t rows = bytes / array.row_bytes();
    if (rows < array.row_count)
        header.refuse("ends after " + std::to_string(rows) + " of " + std::to_string(array.row_count) +
                      " rows: it was cut short");
    if (bytes != array.row_count * array.row_bytes())
        header.refuse("goes on after its " + std::to_string(array.row_count) + " rows");
    array.file = file.all();
    if (array.file.size() != file.size())
        header.refuse("changed while it was read");
    return array;
}

pt_column SphereColumn::column() const {
    return file.empty() ? pt_column{value.data(), 0, PT_TYPE_FLOAT64}
                        : pt_column{array.data(), array.row_bytes(), array.type};
}

void SphereColumns::add_file(const SceneKey &key, const std::string &file, const JsonPlace &place) {
    if (file.empty())
        refuse(place, "must be the name of an NPY file, is \"\"");
    columns.push_back({&key, file});
}

void SphereColumns::add_value(const SceneKey &key, const nlohmann::json &value) {
    columns.push_back({&key, ""});
    for (std::size_t i = 0; i < 3; ++i) {
        const double number = (value.is_array() ? value[i] : value).get<double>();
        columns.back().value[i] = may_be_bytes(key) ? double{static_cast<float>(number)} : number;
    }
}

pt_sphere_array SphereColumns::spheres() const {
    auto array = sized<pt_sphere_array>();
    array.count = static_cast<std::uint32_t>(columns.front().array.row_count);
    array.material = {&material, 0, PT_TYPE_UINT32};
    for (const SphereColumn &each : columns)
        array.*each.key->column = each.column();
    return array;
}

std::vector<std::string> column_paths(const SceneFile &scene) {
    std::vector<std::string> paths;
    for_each_file(scene,
                  [&](const SphereColumns &, const SphereColumn &column) { paths.push_back(path_of(scene, column)); });
    return paths;
}

void read_columns(SceneFile &scene) {
    for_each_file(scene, [&](SphereColumns &each, SphereColumn &column) {
        const std::string path = path_of(scene, column);
        try {
            column.array = read_file(path, [&](platform::InputFile &file) { return read_npy(file, path); });
            check_fit(*column.key, column.array, each.columns.front().array, path);
        } catch (const Error &error) {
            throw Error(error.code(), concat(scene.path, ": ", each.section, "[", each.item, "].", column.key->name,
                                             ": ", error.what()));
        }
    });
}

} // namespace pt
