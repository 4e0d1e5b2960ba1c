// The names of materials that spheres and planes of a scene file have. These may stand before the materials: names are
// numbered as they are met, and looked up at the end.
#pragma once

#include "cli/base/json_path.h"
#include "cli/base/json_value.h"

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace cli {

class MaterialReferences {
public:
    // Of the name; the same one for the same name.
    std::uint32_t number(const JsonPlace &place, const nlohmann::json &name);

    // Number -> index into the names of all materials. Throws JsonRefusal for a name that is none of them.
    std::vector<std::uint32_t> indices(const std::vector<std::string> &materials) const;

private:
    struct UsedName {
        std::string name;
        JsonPath first_place;
    };
    std::vector<UsedName> used_;
    std::unordered_map<std::string, std::uint32_t> numbers_;
};

} // namespace cli
