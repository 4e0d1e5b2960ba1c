// Owns the reading of a whole file.
// Called by the scene file reader and source_files.
#pragma once

#include <string>

namespace cli {

// Throws Failure(ExitCode::file) with the system's reason.
std::string read_file(const std::string &path);

} // namespace cli
