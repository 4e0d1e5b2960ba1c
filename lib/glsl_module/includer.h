// Finds and reads the files that the #include lines of a shader name, for glslang, which calls back.
#pragma once

#include <glslang/Public/ShaderLang.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace pt::glsl {

// Reads a whole file, without a byte order mark; throws std::runtime_error with the system's reason.
std::string read_source(const std::filesystem::path &path);

// Looks beside the including file, then in the directory. glslang's messages use the paths under which files were
// found.
class Includer : public glslang::TShader::Includer {
public:
    Includer(std::filesystem::path directory, const std::filesystem::path &main_file) :
        directory_(std::move(directory)),
        open_files_{main_file} {}

    IncludeResult *includeLocal(const char *name, const char *including_file, std::size_t depth) override;

    // glslang calls this after includeLocal has found nothing, so the reason is given here; and for #include <name>.
    IncludeResult *includeSystem(const char *name, const char *including_file, std::size_t depth) override;

    void releaseInclude(IncludeResult *result) override;

private:
    std::filesystem::path find(const char *name, const char *including_file) const;
    IncludeResult *refuse(const std::string &reason);

    std::filesystem::path directory_;
    std::vector<std::filesystem::path> open_files_; // each included by the one before
    std::string reason_;                            // why the last #include line was refused
    bool is_endless_ = false;                       // a file includes itself: no further #include is followed
};

} // namespace pt::glsl
