#include "cli/scene/scene_override.h"

#include "cli/base/common_options.h"
#include "cli/base/number.h"
#include "cli/scene/scene_keys.h"

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

SceneOverride override_of(const SceneSection &section, const SceneKey &key, nlohmann::json value,
                          const std::string &name) {
    return {{{std::string(section.name)}, {std::string(key.name)}}, std::move(value), name, ExitCode::usage, true};
}

void add_size(CLI::App &command, std::vector<SceneOverride> &overrides) {
    const auto read = [&overrides](const std::string &text) {
        const auto size = parse_size(text);
        if (!size)
            refuse_option("--size", "must be two whole numbers like 1920x1080", text);
        overrides.push_back({{{"film"}, {"width"}}, size->width, "--size: width", ExitCode::usage, true});
        overrides.push_back({{{"film"}, {"height"}}, size->height, "--size: height", ExitCode::usage, true});
    };
    command.add_option_function<std::string>("--size", read, "Pixels (default: the scene's, else 512x512)")
        ->type_name("WxH")
        ->group("Picture");
}

// Before the others, which count more.
void add_set(CLI::App &command, std::vector<SceneOverride> &overrides) {
    const auto read = [&overrides](const std::vector<std::string> &texts) {
        for (const std::string &text : texts)
            overrides.push_back(parse_override(text));
    };
    command
        .add_option_function<std::vector<std::string>>(
            "--set", read,
            "A value in place of the scene's, like camera.vertical_fov=30 or spheres[0].radius=2; may be given again")
        ->expected(1)
        ->take_all()
        ->type_name("PATH=VALUE")
        ->group("Picture");
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

void add_scene_options(CLI::App &command, std::vector<SceneOverride> &overrides, bool has_scene) {
    if (has_scene) {
        add_set(command, overrides);
        add_size(command, overrides);
    }
    for (const SceneSection &section : scene_sections()) {
        const bool is_of_display = section.name == "film";
        for (const SceneKey &key : section.keys) {
            if (key.option.empty() || !(has_scene || is_of_display))
                continue;
            const std::string name(key.option);
            const auto store = [&overrides, &section, &key, name](const nlohmann::json &value) {
                overrides.push_back(override_of(section, key, value, name));
            };
            const std::string help = std::string(key.words) + " (default: " + (has_scene ? "the scene's, else " : "") +
                                     std::string(key.initial) + ")";
            add_value(command, name, key.rule, store, help)
                ->group(is_of_display ? "Display (.png and .jpg only)" : "Samples");
        }
    }
}

} // namespace cli
