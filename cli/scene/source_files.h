// The files that a picture is made of: the scene, its data, and the kernels with what they include.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace cli {

// Contents by path; nothing for a file that does not exist. Data may be larger than memory: what stands for them
// changes when they are written. An included file is listed at both places where it is looked for, since it may appear
// at either.
using SourceFiles = std::map<std::filesystem::path, std::optional<std::string>>;

// shader_dir may be empty: the kernels in the library are no files.
SourceFiles read_shader_files(const std::filesystem::path &shader_dir);
SourceFiles read_source_files(const std::filesystem::path &scene, const std::filesystem::path &shader_dir,
                              const std::set<std::filesystem::path> &data);

} // namespace cli
