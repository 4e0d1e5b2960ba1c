// Which program a scene is of.
#pragma once

#include "cli/import/foreign_scene.h"

#include <optional>
#include <string>
#include <string_view>

namespace cli {

enum class ForeignFormat { nff, tachyon };

// By its first words, or else by its name; nothing for a scene file.
std::optional<ForeignFormat> foreign_format(std::string_view text, const std::string &path);

// Throws Failure(ExitCode::scene) with file and line.
ForeignScene read_foreign_scene(ForeignFormat format, std::string_view text, const std::string &path);

} // namespace cli
