#include "lib/api/guard.h"
#include "lib/base/struct_size.h"
#include "lib/platform/printable.h"
#include "lib/scene_file/animation.h"
#include "lib/scene_file/scene_file.h"
#include "lib/scene_file/scene_schema.h"

#include <pt/scene_file.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

struct pt_scene_file {
    pt::SceneFile read;
    std::size_t animated_count = 0; // overrides of the animation, which come first
    std::vector<pt_sphere_array> arrays;
    std::vector<std::string> column_paths;
    std::string message;
};

namespace {

thread_local pt::LastError last_error;

template <typename Call>
pt_result guarded(const Call &call) noexcept {
    return pt::guard(last_error, call);
}

pt::SceneOverride override_of(const pt_scene_override &given) {
    pt::require_not_null(given.setting, "overrides.setting");
    pt::SceneOverride override = pt::parse_override(given.setting, "");
    if (given.name != nullptr) {
        override.source = given.name;
        override.is_its_name = true;
    }
    return override;
}

std::vector<pt::SceneOverride> overrides_of(const pt_scene_file_info &info) {
    if (info.override_count > 0 && info.overrides == nullptr)
        pt::refuse_argument("info", "overrides", "NULL", "must not be NULL with an override_count");
    std::vector<pt::SceneOverride> overrides;
    for (std::uint32_t i = 0; i < info.override_count; ++i)
        overrides.push_back(override_of(info.overrides[i]));
    return overrides;
}

void check(const pt_scene_file_info &info) {
    constexpr std::uint32_t known_flags = PT_SCENE_FILE_FRAME;
    if (info.path == nullptr)
        pt::refuse_argument("info", "path", "NULL", "must not be NULL");
    if ((info.flags & ~known_flags) != 0)
        pt::refuse_argument("info", "flags", std::to_string(info.flags), "must be PT_SCENE_FILE_FRAME or 0",
                            PT_ERROR_UNSUPPORTED);
    if (info.frame != 0 && info.flags == 0)
        pt::refuse_argument("info", "frame", std::to_string(info.frame), "must be 0 without PT_SCENE_FILE_FRAME");
    if (info.text == nullptr && info.text_bytes != 0)
        pt::refuse_argument("info", "text_bytes", std::to_string(info.text_bytes), "must be 0 without a text");
}

pt::SceneFile read(const pt_scene_file_info &info, std::vector<pt::SceneOverride> overrides) {
    return info.text == nullptr ? pt::scene_of_file(info.path, std::move(overrides))
                                : pt::scene_of_text({info.text, info.text_bytes}, info.path, std::move(overrides));
}

std::unique_ptr<pt_scene_file> opened(const pt_scene_file_info &info) {
    const std::vector<pt::SceneOverride> overrides = overrides_of(info);
    auto file = std::make_unique<pt_scene_file>();
    file->read = read(info, overrides);
    if ((info.flags & PT_SCENE_FILE_FRAME) != 0)
        file->read = pt::scene_in_frame(file->read, info.frame);
    file->animated_count = file->read.overrides.size() - overrides.size();
    pt::read_columns(file->read);
    file->arrays = file->read.sphere_arrays();
    file->column_paths = pt::column_paths(file->read);
    return file;
}

pt_scene scene_of(const pt_scene_file &file) {
    pt_scene scene = file.read.scene();
    scene.sphere_arrays = file.arrays.data();
    scene.sphere_array_count = static_cast<std::uint32_t>(file.arrays.size());
    return scene;
}

pt_scene_film film_of(const pt::SceneFile &file) {
    auto film = pt::sized<pt_scene_film>();
    film.sample_count = file.sample_count.value_or(0);
    film.display = file.display;
    return film;
}

pt::BrokenRule owned(const pt_broken_rule &rule) {
    const auto text = [](const char *given) { return std::string(given == nullptr ? "" : given); };
    return {text(rule.subject), rule.index,       text(rule.member), rule.component,
            text(rule.with),    text(rule.value), text(rule.rule)};
}

std::int64_t index_of(const pt_scene_file &file, const pt::SceneOverride *cause) {
    const std::int64_t index = cause == nullptr ? -1 : cause - file.read.overrides.data();
    return index < static_cast<std::int64_t>(file.animated_count)
               ? -1
               : index - static_cast<std::int64_t>(file.animated_count);
}

} // namespace

pt_result pt_open_scene_file(const pt_scene_file_info *info, pt_scene_file **file) {
    return guarded([&] {
        pt::require_not_null(file, "file");
        *file = nullptr;
        const pt_scene_file_info known = pt::copy_in(info, "info");
        check(known);
        *file = opened(known).release();
    });
}

void pt_close_scene_file(pt_scene_file *file) {
    delete file;
}

pt_result pt_get_scene_file(const pt_scene_file *file, pt_scene *scene, pt_camera *camera, pt_render *render,
                            pt_scene_film *film) {
    return guarded([&] {
        pt::require_not_null(file, "file");
        const std::uint32_t scene_size = scene == nullptr ? 0 : pt::struct_size_of(scene, "scene");
        const std::uint32_t camera_size = camera == nullptr ? 0 : pt::struct_size_of(camera, "camera");
        const std::uint32_t render_size = render == nullptr ? 0 : pt::struct_size_of(render, "render");
        const std::uint32_t film_size = film == nullptr ? 0 : pt::struct_size_of(film, "film");
        if (scene != nullptr)
            pt::copy_known(scene_of(*file), scene, scene_size);
        if (camera != nullptr)
            pt::copy_known(file->read.camera, camera, camera_size);
        if (render != nullptr)
            pt::copy_known(file->read.render, render, render_size);
        if (film != nullptr)
            pt::copy_known(film_of(file->read), film, film_size);
    });
}

const char *pt_get_column_path(const pt_scene_file *file, std::uint32_t index) {
    return file != nullptr && index < file->column_paths.size() ? file->column_paths[index].c_str() : nullptr;
}

pt_result pt_find_rule_source(pt_scene_file *file, const pt_broken_rule *rule, pt_rule_source *source) {
    return guarded([&] {
        pt::require_not_null(file, "file");
        const pt::BrokenRule broken = owned(pt::copy_in(rule, "rule"));
        const std::uint32_t size = pt::struct_size_of(source, "source");
        const pt::RuleSource found = file->read.source_of(broken);
        file->message = platform::printable_lines(found.message);
        auto result = pt::sized<pt_rule_source>();
        result.line = static_cast<std::uint32_t>(found.line);
        result.override_index = index_of(*file, found.cause);
        result.message = file->message.c_str();
        pt::copy_known(result, source, size);
    });
}

const char *pt_get_scene_schema(void) {
    const char *text = nullptr;
    guarded([&] {
        static const std::string schema = pt::scene_schema();
        text = schema.c_str();
    });
    return text;
}

const char *pt_last_scene_error(void) {
    return last_error.c_str();
}
