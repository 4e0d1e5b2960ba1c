#pragma once

#include <string>

namespace pt {

// JSON Schema of scene files, draft 7 (json-schema.org/draft-07). Rules on two values (names of materials, look_at, up)
// are left to the reader.
std::string scene_schema();

} // namespace pt
