// Which images a command writes, from what its options -o and --format say; checked before there is anything to lose.
#pragma once

#include "cli/image/image_file.h"
#include "cli/image/image_window.h"

#include <optional>
#include <span>
#include <string>

namespace cli {

// Throws Failure(ExitCode::usage) for a file whose name tells no format, for standard output without --format or on a
// terminal, and for --format without standard output.
void check_image_names(std::span<const std::string> paths, std::optional<ImageFormat> format);

// Of a path that passed these checks. format: of standard output.
ImageTarget image_target(const std::string &path, std::optional<ImageFormat> format);

// Throws Failure: ExitCode::usage for an image that is too large for its format, ExitCode::file for a file that cannot
// be written.
void check_image_target(const ImageTarget &target, const ImageWindow &window);

} // namespace cli
