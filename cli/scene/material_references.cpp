#include "cli/scene/material_references.h"

#include "cli/base/suggestion.h"

#include <string_view>

namespace cli {

std::uint32_t MaterialReferences::number(const JsonPlace &place, const nlohmann::json &name) {
    const auto [entry, fresh] =
        numbers_.try_emplace(std::string(read_text(name, place)), static_cast<std::uint32_t>(used_.size()));
    if (fresh)
        used_.push_back({entry->first, place.path()});
    return entry->second;
}

std::vector<std::uint32_t> MaterialReferences::indices(const std::vector<std::string> &materials) const {
    std::unordered_map<std::string_view, std::uint32_t> defined;
    for (const std::string &name : materials)
        defined.emplace(name, static_cast<std::uint32_t>(defined.size()));
    std::vector<std::uint32_t> indices;
    for (const UsedName &used : used_) {
        const auto found = defined.find(used.name);
        if (found == defined.end()) {
            const std::vector<std::string_view> known(materials.begin(), materials.end());
            throw JsonRefusal(used.first_place, unknown_name("material", used.name, known));
        }
        indices.push_back(found->second);
    }
    return indices;
}

} // namespace cli
