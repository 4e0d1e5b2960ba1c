#include "tests/fuzz/input.h"
#include "tests/fuzz/require.h"

#include <pt/scene_file.h>

#include <memory>
#include <string>

namespace {

constexpr const char *path = "scene.json";

struct Close {
    void operator()(pt_scene_file *file) const { pt_close_scene_file(file); }
};
using File = std::unique_ptr<pt_scene_file, Close>;

void examine_scene(const pt_scene_file *file, std::span<const std::uint8_t> bytes) {
    auto scene = sized<pt_scene>();
    fuzz::Input input;
    fuzz::require(pt_get_scene_file(file, &scene, &input.camera, &input.render, nullptr) == PT_OK, "a file gives all");
    input.materials.assign(scene.materials, scene.materials + scene.material_count);
    input.spheres.assign(scene.spheres, scene.spheres + scene.sphere_count);
    input.planes.assign(scene.planes, scene.planes + scene.plane_count);
    fuzz::examine(input, bytes);
}

void examine_rule(pt_scene_file *file, const std::string &text) {
    auto rule = sized<pt_broken_rule>();
    rule.index = rule.component = static_cast<std::int32_t>(text.size());
    rule.subject = rule.member = rule.with = rule.value = rule.rule = text.c_str();
    auto source = sized<pt_rule_source>();
    fuzz::require(pt_find_rule_source(file, &rule, &source) == PT_OK, "every rule has a message");
    fuzz::require(std::string_view(source.message).starts_with(path), "messages are led back to the file");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    const std::string text(data, data + size);
    auto info = sized<pt_scene_file_info>();
    info.path = path;
    info.text = text.c_str();
    info.text_bytes = text.size();
    pt_scene_file *opened = nullptr;
    const pt_result result = pt_open_scene_file(&info, &opened);
    const File file(opened);
    if (result == PT_OK) {
        examine_rule(file.get(), text);
        examine_scene(file.get(), {data, size});
        return 0;
    }
    fuzz::require(result == PT_ERROR_INVALID_SCENE || result == PT_ERROR_FILE, "what is refused is the files' fault");
    fuzz::require(opened == nullptr && std::string_view(pt_last_scene_error()).starts_with(path),
                  "messages name the file");
    return 0;
}
