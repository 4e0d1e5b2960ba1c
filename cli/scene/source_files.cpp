#include "cli/scene/source_files.h"

#include "cli/base/exit_code.h"
#include "cli/base/text_file.h"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <system_error>
#include <vector>

namespace cli {
namespace {

std::optional<std::string> contents_of(const std::filesystem::path &path) {
    try {
        return read_file(path.string());
    } catch (const Failure &) {
        return std::nullopt;
    }
}

// Its size and the time of its last change.
std::optional<std::string> state_of(const std::filesystem::path &path) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (error)
        return std::nullopt;
    const auto time = std::filesystem::last_write_time(path, error);
    return std::to_string(size) + " bytes at " + std::to_string(time.time_since_epoch().count());
}

// The name in a line `#include "name"`, blanks allowed; empty for other lines. Lines that the preprocessor would skip
// count too: a file too many does no harm.
std::string_view included_name(std::string_view line) {
    const auto skip = [&](std::string_view word) {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        const bool found = line.substr(0, word.size()) == word;
        line.remove_prefix(found ? word.size() : 0);
        return found;
    };
    if (!skip("#") || !skip("include") || !skip("\""))
        return {};
    const std::size_t end = line.find('"');
    return end == std::string_view::npos ? std::string_view() : line.substr(0, end);
}

} // namespace

SourceFiles read_shader_files(const std::filesystem::path &shader_dir) {
    SourceFiles files;
    std::vector<std::filesystem::path> to_read;
    if (!shader_dir.empty()) {
        for (const char *kernel : {"pathtrace.comp", "commit.comp", "fold.comp", "add.comp", "resolve.comp",
                                   "estimate.comp", "accuracy.comp", "first_hit.comp", "coverage.comp"}) {
            to_read.push_back(shader_dir / kernel);
        }
    }
    while (!to_read.empty()) {
        const std::filesystem::path path = to_read.back().lexically_normal();
        to_read.pop_back();
        const auto [file, is_new] = files.try_emplace(path);
        if (!is_new)
            continue;
        file->second = contents_of(path);
        std::istringstream lines(file->second.value_or(""));
        for (std::string line; std::getline(lines, line);) {
            if (const std::string_view name = included_name(line); !name.empty()) {
                to_read.push_back(path.parent_path() / name);
                to_read.push_back(shader_dir / name);
            }
        }
    }
    return files;
}

SourceFiles read_source_files(const std::filesystem::path &scene, const std::filesystem::path &shader_dir,
                              const std::set<std::filesystem::path> &data) {
    SourceFiles files = read_shader_files(shader_dir);
    files.try_emplace(scene, contents_of(scene));
    for (const std::filesystem::path &path : data)
        files.try_emplace(path, state_of(path));
    return files;
}

} // namespace cli
