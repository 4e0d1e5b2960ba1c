// The sections `film` and `render` of a scene file: the picture, and how it is made.
#pragma once

#include "cli/base/json_value.h"
#include "cli/scene/scene_file.h"

namespace cli {

// Of one key; throw JsonRefusal.
void read_film_item(SceneFile &scene, const JsonPlace &place, const nlohmann::json &value);
void read_render_item(SceneFile &scene, const JsonPlace &place, const nlohmann::json &value);

} // namespace cli
