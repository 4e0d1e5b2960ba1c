// The JSON Schema of scene files, for editors and programs that write them.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace cli {

// Draft 7 (json-schema.org/draft-07), which editors know. What it refuses `pt` refuses too; what needs two values to be
// known (names of materials, a look_at that is not the position, an up along the view), `pt` refuses alone.
nlohmann::ordered_json scene_schema();

} // namespace cli
