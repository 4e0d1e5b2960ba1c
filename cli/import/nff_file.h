// Scenes in Eric Haines' Neutral File Format, of which spheres are read (realtimerendering.com/resources/SPD/NFF.TXT).
#pragma once

#include "cli/import/foreign_scene.h"

#include <string>
#include <string_view>

namespace cli {

// Throws Failure(ExitCode::scene) with file and line.
ForeignScene read_nff(std::string_view text, const std::string &path);

} // namespace cli
