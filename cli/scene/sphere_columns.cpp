#include "cli/scene/sphere_columns.h"

#include "cli/base/text_file.h"
#include "cli/scene/scene_file.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string_view>

namespace cli {
namespace {

using nlohmann::json;

// A key with its place in pt_sphere_array.
struct ColumnKind {
    std::string_view name;
    pt_column pt_sphere_array::*column;
    std::size_t length; // numbers of a sphere
    bool may_be_bytes;
};

constexpr std::array<ColumnKind, 4> kinds{{{"center", &pt_sphere_array::center, 3, false},
                                           {"radius", &pt_sphere_array::radius, 1, false},
                                           {"motion", &pt_sphere_array::motion, 3, false},
                                           {"color", &pt_sphere_array::color, 3, true}}};

const ColumnKind &kind_of(std::string_view name) {
    return *std::find_if(kinds.begin(), kinds.end(), [&](const ColumnKind &each) { return each.name == name; });
}

// A value for all, as a single sphere has it.
std::array<double, 3> read_value(const ColumnKind &kind, const json &value, const JsonPlace &place) {
    if (kind.length == 1)
        return {read_number(value, place), 0.0, 0.0};
    if (!kind.may_be_bytes)
        return read_vector(value, place);
    const std::array<float, 3> color = read_colour(value, place);
    return {color[0], color[1], color[2]};
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

void require_shape(const ColumnKind &kind, const NpyArray &array, const std::string &path) {
    const std::size_t length = std::max<std::size_t>(array.row_length, 1);
    const std::string shape = "(" + std::to_string(array.row_count) + "," +
                              (array.row_length == 0 ? "" : " " + std::to_string(array.row_length)) + ")";
    if (length != kind.length || (kind.length == 1) != (array.row_length == 0))
        throw Failure(ExitCode::scene,
                      path + ": has the shape " + shape + ", must be " + (kind.length == 1 ? "(N,)" : "(N, 3)"));
    if (array.type == PT_TYPE_SRGB8 && !kind.may_be_bytes)
        throw Failure(ExitCode::scene,
                      path + ": has numbers of the type |u1, which colors alone may have; must be <f4 or <f8");
    if (array.row_count > std::numeric_limits<std::uint32_t>::max())
        throw Failure(ExitCode::scene, path + ": has more than 4294967295 rows");
}

} // namespace

pt_column SphereColumn::column() const {
    return file.empty() ? pt_column{value.data(), 0, PT_TYPE_FLOAT64}
                        : pt_column{array.data(), array.row_bytes(), array.type};
}

pt_sphere_array SphereColumns::spheres() const {
    pt_sphere_array array{};
    array.struct_size = sizeof array;
    array.count = static_cast<std::uint32_t>(columns.front().array.row_count); // of the centers
    array.material = {&material, 0, PT_TYPE_UINT32};
    for (const SphereColumn &each : columns)
        array.*kind_of(each.name).column = each.column();
    return array;
}

bool is_sphere_columns(const json &item) {
    const auto center = item.find("center");
    return center != item.end() && center->is_string();
}

SphereColumns read_sphere_columns(const JsonPlace &place, const json &value) {
    const JsonObject object(value, place, {"center", "radius", "material", "motion", "color"});
    object.require("radius");
    object.require("material");
    SphereColumns spheres;
    spheres.item = place.index;
    for (const ColumnKind &kind : kinds) {
        const json *given = object.find(kind.name.data());
        if (given == nullptr)
            continue;
        const JsonPlace member = place.member(kind.name);
        SphereColumn column{std::string(kind.name), {}, {}, {}};
        if (!given->is_string())
            column.value = read_value(kind, *given, member);
        else if (column.file = read_text(*given, member); column.file.empty())
            refuse(member, "must be the name of an NPY file, is \"\"");
        spheres.columns.push_back(std::move(column));
    }
    return spheres;
}

std::vector<std::string> column_paths(const SceneFile &scene) {
    std::vector<std::string> paths;
    for_each_file(scene,
                  [&](const SphereColumns &, const SphereColumn &column) { paths.push_back(path_of(scene, column)); });
    return paths;
}

void load_columns(SceneFile &scene) {
    for_each_file(scene, [&](SphereColumns &each, SphereColumn &column) {
        const std::string path = path_of(scene, column);
        try {
            column.array = parse_npy(read_file(path), path);
            require_shape(kind_of(column.name), column.array, path);
            const NpyArray &centers = each.columns.front().array;
            if (column.array.row_count != centers.row_count)
                throw Failure(ExitCode::scene, path + ": has " + std::to_string(column.array.row_count) +
                                                   " rows, and the centers " + std::to_string(centers.row_count));
        } catch (const Failure &failure) {
            throw Failure(failure.code(), scene.path + ": spheres[" + std::to_string(each.item) + "]." + column.name +
                                              ": " + failure.what());
        }
    });
}

} // namespace cli
