#pragma once

#include <string>

namespace pt {

// Returns the JSON Schema of scene files, draft 7 (json-schema.org/draft-07). It does not have rules on two values
// (names of materials, look_at, up).
std::string scene_schema();

} // namespace pt
