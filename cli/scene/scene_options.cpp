#include "cli/scene/scene_options.h"

#include "cli/base/number.h"
#include "cli/base/options.h"
#include "cli/scene/scene.h"
#include "lib/scene_file/scene_keys.h"

#include <string>
#include <utility>

namespace cli {
namespace {

SceneOverride override_of(const pt::SceneSection &section, const pt::SceneKey &key, nlohmann::json value,
                          const std::string &name) {
    return {{{std::string(section.name)}, {std::string(key.name)}},
            std::move(value),
            name,
            PT_ERROR_INVALID_ARGUMENT,
            true};
}

void add_size(CLI::App &command, std::vector<SceneOverride> &overrides) {
    const auto read = [&overrides](const std::string &text) {
        const auto size = parse_numbers<2>(text, 'x'); // the library checks the ranges
        if (!size)
            refuse_option("--size", "must be two whole numbers like 1920x1080", text);
        overrides.push_back({{{"film"}, {"width"}}, (*size)[0], "--size: width", PT_ERROR_INVALID_ARGUMENT, true});
        overrides.push_back({{{"film"}, {"height"}}, (*size)[1], "--size: height", PT_ERROR_INVALID_ARGUMENT, true});
    };
    command.add_option_function<std::string>("--size", read, "Pixels (default: the scene's, else 512x512)")
        ->type_name("WxH")
        ->group("Picture");
}

} // namespace

void add_set(CLI::App &command, std::vector<SceneOverride> &overrides) {
    const auto read = [&overrides](const std::vector<std::string> &texts) {
        for (const std::string &text : texts)
            overrides.push_back(with_exit_code([&] { return pt::parse_override(text, "--set "); }));
    };
    command
        .add_option_function<std::vector<std::string>>(
            "--set", read,
            "Replace a value of the scene, such as camera.vertical_fov=30 or spheres[0].radius=2; may be given again")
        ->expected(1)
        ->take_all()
        ->type_name("PATH=VALUE")
        ->group("Picture");
}

void add_scene_options(CLI::App &command, std::vector<SceneOverride> &overrides, bool has_scene) {
    if (has_scene) {
        add_set(command, overrides); // applied first, so that later ones override it
        add_size(command, overrides);
    }
    for (const pt::SceneSection &section : pt::scene_sections()) {
        const bool is_of_display = section.name == "film";
        for (const pt::SceneKey &key : section.keys) {
            if (key.option.empty() || !(has_scene || is_of_display))
                continue;
            const std::string name(key.option);
            const auto store = [&overrides, &section, &key, name](const nlohmann::json &value) {
                overrides.push_back(override_of(section, key, value, name));
            };
            const std::string help = std::string(key.words) + " (default: " + (has_scene ? "the scene's, else " : "") +
                                     std::string(key.initial) + ")";
            add_value(command, name, key.rule, store, help)
                ->group(is_of_display ? "Display (tone-mapped files only)" : "Samples");
        }
    }
}

} // namespace cli
