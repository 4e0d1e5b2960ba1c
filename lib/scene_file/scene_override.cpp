#include "lib/scene_file/scene_override.h"

#include <algorithm>
#include <utility>

namespace pt {
namespace {

using nlohmann::json;

json &enter(json &parent, const JsonStep &step, const SceneOverride &cause) {
    if (!step.in_array && parent.is_null())
        parent = json::object();
    if (step.in_array ? !parent.is_array() || step.index >= parent.size() : !parent.is_object())
        throw Error(cause.blame, cause.source + ": the scene has no " + path_text(cause.path));
    return step.in_array ? parent[step.index] : parent[step.key];
}

} // namespace

SceneOverride parse_override(const std::string &text, const std::string &name) {
    const auto parsed = parse_path(text);
    if (!parsed || !parsed->rest.starts_with('=') || parsed->path.size() < item_depth) {
        throw Error(PT_ERROR_INVALID_ARGUMENT, name + text +
                                                   ": must be a value within a section of the scene, like "
                                                   "camera.vertical_fov=30 or spheres[0].radius=2");
    }
    const std::string value(parsed->rest.substr(1));
    json read = json::parse(value, nullptr, false);
    return {parsed->path, read.is_discarded() ? json(value) : std::move(read), name + text, PT_ERROR_INVALID_ARGUMENT};
}

void SceneOverride::apply_to(json &item) const {
    json *part = &item;
    for (auto step = path.begin() + item_depth; step != path.end(); ++step)
        part = &enter(*part, *step, *this);
    *part = value;
}

} // namespace pt
