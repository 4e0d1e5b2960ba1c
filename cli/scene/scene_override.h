// Values that take the place of a scene file's, or are added to it: of --set, and of the frames of an animation.
#pragma once

#include "cli/base/exit_code.h"
#include "cli/base/json_path.h"
#include "cli/scene/json_sections.h"

#include <nlohmann/json.hpp>

#include <set>
#include <span>
#include <string>
#include <vector>

namespace cli {

struct SceneOverride {
    JsonPath path; // of a value within a section
    nlohmann::json value;
    std::string source; // for messages: "--set camera.vertical_fov=30"
    ExitCode blame;     // where the source is wrong
};

// "camera.vertical_fov=30". The value is JSON; what is none is a text, so that names need no quotes. Throws
// Failure(ExitCode::usage).
SceneOverride parse_override(const std::string &text);

// Stands between the parser and the reader of a scene file: items with values to be replaced are handed on with these.
// Members that an object of the file lacks are added; elements of arrays have to be there.
class OverridingHandler : public JsonSectionHandler {
public:
    // Refers to both.
    OverridingHandler(JsonSectionHandler &reader, std::span<const SceneOverride> overrides) :
        reader_(reader),
        overrides_(overrides) {}

    // All throw Failure for an override that does not fit, or whose value the reader refuses, and blame its source.
    void begin_section(const JsonPlace &place, nlohmann::json::value_t kind) override {
        reader_.begin_section(place, kind);
    }
    void item(const JsonPlace &place, const nlohmann::json &value) override;

    // At the end of the file: adds the items that it does not have.
    void finish();

private:
    std::vector<std::size_t> overrides_of(const JsonPath &item) const;
    void hand_on(const JsonPlace &place, nlohmann::json value, std::span<const std::size_t> chosen);

    JsonSectionHandler &reader_;
    std::span<const SceneOverride> overrides_;
    std::set<std::size_t> used_; // indices of overrides
};

} // namespace cli
