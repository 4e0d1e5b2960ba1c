// The files that a picture is made of: the scene, and the kernels with what they include.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace cli {

// Contents by path; nothing for a file that does not exist. An included file is listed at both places where it is
// looked for, since it may appear at either.
using SourceFiles = std::map<std::filesystem::path, std::optional<std::string>>;

// shader_dir may be empty: the kernels in the library are no files. Scene files include none.
SourceFiles read_shader_files(const std::filesystem::path &shader_dir);
SourceFiles read_source_files(const std::filesystem::path &scene, const std::filesystem::path &shader_dir);

} // namespace cli
