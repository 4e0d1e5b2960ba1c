#pragma once

#include <string>

namespace pt {

// Returns the JSON Schema of scene files, draft 7 (json-schema.org/draft-07). Rules that involve two values (names of
// materials, look_at, up) are left out.
std::string scene_schema();

} // namespace pt
