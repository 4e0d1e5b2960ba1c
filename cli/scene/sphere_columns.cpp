#include "cli/scene/sphere_columns.h"

#include "cli/base/text.h"
#include "cli/base/text_file.h"
#include "cli/scene/scene_keys.h"

#include <filesystem>
#include <limits>

namespace cli {
namespace {

// Numbers of a sphere.
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

// centers: with as many rows.
void check_fit(const SceneKey &key, const NpyArray &array, const NpyArray &centers, const std::string &path) {
    const auto refuse_if = [&](bool is_refused, const std::string &what) {
        if (is_refused)
            throw Failure(ExitCode::scene, path + ": has " + what);
    };
    const bool is_single = length_of(key) == 1;
    refuse_if(is_single ? array.row_length != 0 : array.row_length != length_of(key),
              concat("the shape (", array.row_count, ",", array.row_length == 0 ? "" : concat(" ", array.row_length),
                     "), must be ", is_single ? "(N,)" : "(N, 3)"));
    refuse_if(array.type == PT_TYPE_SRGB8 && !may_be_bytes(key),
              "numbers of the type |u1, which colors alone may have; must be <f4 or <f8");
    refuse_if(array.row_count > std::numeric_limits<std::uint32_t>::max(), "more than 4294967295 rows");
    refuse_if(array.row_count != centers.row_count,
              concat(array.row_count, " rows, and the centers ", centers.row_count));
}

} // namespace

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
    array.count = static_cast<std::uint32_t>(columns.front().array.row_count); // of the centers
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

void load_columns(SceneFile &scene) {
    for_each_file(scene, [&](SphereColumns &each, SphereColumn &column) {
        const std::string path = path_of(scene, column);
        try {
            column.array = parse_npy(read_file(path), path);
            check_fit(*column.key, column.array, each.columns.front().array, path);
        } catch (const Failure &failure) {
            throw Failure(failure.code(),
                          concat(scene.path, ": spheres[", each.item, "].", column.key->name, ": ", failure.what()));
        }
    });
}

} // namespace cli
