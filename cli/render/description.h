// What a command line and a scene file come to, for other programs that render: as numbers, without the words of
// either.
#pragma once

#include "cli/scene/render_settings.h"
#include "cli/scene/scene_file.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace cli {

// Scene, camera and settings as the library takes them (pt.h), how pictures of them are shown, and the environment that
// the program gives the driver. A sphere is a row of center, radius, motion, material and, where any has one, colour;
// an array has columns of float64, float32 and uint8 by base64, in the order of the machine's bytes. frame: of an
// animation; nothing: a picture.
nlohmann::ordered_json description_of(const SceneFile &file, const RenderSettings &settings,
                                      std::optional<std::uint32_t> frame);

// An object as one line.
std::string description_line(const nlohmann::ordered_json &description);

} // namespace cli
