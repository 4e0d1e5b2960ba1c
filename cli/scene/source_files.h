// Owns the knowledge of which files a picture is made of: the scene, and the kernels with what they include.
// Called by source_watch and render_output.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace cli {

// Their contents by path; nothing for a file that is not there. One that an #include line may mean is listed in both
// places where it is looked for: it may come to be there.
using SourceFiles = std::map<std::filesystem::path, std::optional<std::string>>;

// shader_dir may be empty: the kernels in the library are no files. Scene files include none.
SourceFiles read_shader_files(const std::filesystem::path &shader_dir);
SourceFiles read_source_files(const std::filesystem::path &scene, const std::filesystem::path &shader_dir);

} // namespace cli
