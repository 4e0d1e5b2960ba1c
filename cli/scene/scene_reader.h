// Reads the sections of a scene file by the table of its keys, with the values that take the place of its own.
#pragma once

#include "cli/scene/json_items.h"
#include "cli/scene/scene_keys.h"

#include <cstdint>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace cli {

class SceneReader : public JsonItemHandler {
public:
    // With the overrides that the scene has.
    explicit SceneReader(SceneFile &scene) : scene_(scene) {}

    // All throw JsonRefusal, or Failure for an override that does not fit or whose value is refused.
    void begin_section(const JsonPlace &place, nlohmann::json::value_t kind) override;
    void item(const JsonPlace &place, const nlohmann::json &value) override;

    // At the end of the file: adds what overrides have and the file has not, checks what can be known only now, and
    // resolves the names of materials, which may stand behind the spheres.
    void finish();

private:
    std::vector<std::size_t> overrides_of(const JsonPath &item) const;
    void read_changed(const JsonPlace &place, nlohmann::json value, const std::vector<std::size_t> &changes);
    void read(const JsonPlace &place, const nlohmann::json &value);
    void read_member(const JsonPlace &place, const nlohmann::json &value);
    void read_element(const JsonPlace &place, const nlohmann::json &value);
    void add(SceneItem &item, const JsonPlace &place);
    void add_items_of_overrides();
    void require_members() const;
    std::uint32_t number_of_material(const std::string &name, const JsonPlace &place);
    void resolve_materials();

    SceneFile &scene_;
    const SceneSection *section_ = nullptr; // nullptr: `animation`
    std::set<const SceneSection *> begun_;
    std::set<std::size_t> used_overrides_;

    // Names of materials are numbered as spheres and planes have them.
    struct UsedName {
        std::string name;
        JsonPath first_place;
    };
    std::vector<UsedName> used_materials_;
    std::unordered_map<std::string, std::uint32_t> material_numbers_;
};

} // namespace cli
