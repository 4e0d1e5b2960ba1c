#include "cli/scene/scene_override.h"

#include <utility>

namespace cli {
namespace {

using nlohmann::json;

// The value at that step of a parent, made if it may be.
json &enter(json &parent, const JsonStep &step, const SceneOverride &cause) {
    if (!step.in_array && parent.is_null())
        parent = json::object(); // just made
    if (step.in_array ? !parent.is_array() || step.index >= parent.size() : !parent.is_object())
        throw Failure(cause.blame, cause.source + ": the scene has no " + path_text(cause.path));
    return step.in_array ? parent[step.index] : parent[step.key];
}

} // namespace

SceneOverride parse_override(const std::string &text) {
    const auto parsed = parse_path(text);
    if (!parsed || !parsed->rest.starts_with('=') || parsed->path.size() < item_depth) {
        throw Failure(ExitCode::usage,
                      "--set " + text +
                          ": must be a value within a section of the scene, like camera.vertical_fov=30 "
                          "or spheres[0].radius=2");
    }
    const std::string value(parsed->rest.substr(1));
    json read = json::parse(value, nullptr, false);
    return {parsed->path, read.is_discarded() ? json(value) : std::move(read), "--set " + text, ExitCode::usage};
}

void SceneOverride::apply_to(json &item) const {
    json *part = &item;
    for (auto step = path.begin() + item_depth; step != path.end(); ++step)
        part = &enter(*part, *step, *this);
    *part = value;
}

} // namespace cli
