#include "cli/scene/scene_override.h"

#include <algorithm>
#include <utility>

namespace cli {
namespace {

using nlohmann::json;

constexpr std::size_t item_depth = 2; // steps from the root to an item of a section

Failure failure(const SceneOverride &cause, const std::string &reason) {
    return {cause.blame, cause.source + ": " + reason};
}

// The value at that step of a parent, made if it may be.
json &enter(json &parent, const JsonStep &step, const SceneOverride &cause) {
    if (step.in_array) {
        if (!parent.is_array() || step.index >= parent.size())
            throw failure(cause, "the scene has no " + path_text(cause.path));
        return parent[step.index];
    }
    if (parent.is_null())
        parent = json::object(); // just made
    if (!parent.is_object())
        throw failure(cause, "the scene has no " + path_text(cause.path));
    return parent[step.key];
}

void apply(json &item, const SceneOverride &change) {
    json *value = &item;
    for (auto step = change.path.begin() + item_depth; step != change.path.end(); ++step)
        value = &enter(*value, *step, change);
    *value = change.value;
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

std::vector<std::size_t> OverridingHandler::overrides_of(const JsonPath &item) const {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < overrides_.size(); ++i)
        if (is_within(overrides_[i].path, item))
            chosen.push_back(i);
    return chosen;
}

void OverridingHandler::hand_on(const JsonPlace &place, json value, std::span<const std::size_t> chosen) {
    for (const std::size_t index : chosen) {
        apply(value, overrides_[index]);
        used_.insert(index);
    }
    try {
        reader_.item(place, value);
    } catch (const JsonRefusal &refusal) {
        for (const std::size_t index : chosen) {
            const SceneOverride &cause = overrides_[index];
            if (is_within(refusal.path, cause.path) || is_within(cause.path, refusal.path))
                throw failure(cause, path_text(refusal.path) + ": " + refusal.what());
        }
        throw;
    }
}

// A scene may have millions of items: most of them are looked up and handed on as they are.
void OverridingHandler::item(const JsonPlace &place, const json &value) {
    const std::vector<std::size_t> chosen =
        overrides_.empty() ? std::vector<std::size_t>() : overrides_of(place.path());
    if (chosen.empty())
        reader_.item(place, value);
    else
        hand_on(place, value, chosen);
}

void OverridingHandler::finish() {
    for (std::size_t i = 0; i < overrides_.size(); ++i) {
        if (used_.contains(i))
            continue;
        const SceneOverride &first = overrides_[i];
        const JsonPath item(first.path.begin(), first.path.begin() + item_depth);
        if (item[0].in_array || item[1].in_array)
            throw failure(first, "the scene has no " + path_text(item));
        const JsonPlace root;
        const JsonPlace section = root.member(item[0].key);
        try {
            reader_.begin_section(section, json::value_t::object);
        } catch (const JsonRefusal &refusal) {
            throw failure(first, refusal.what());
        }
        hand_on(section.member(item[1].key), nullptr, overrides_of(item));
    }
}

} // namespace cli
