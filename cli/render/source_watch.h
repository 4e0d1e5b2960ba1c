// Watches a picture's sources (scene, data, kernels) for changes.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cli {

// Including subfolders; none if the name is empty.
std::set<std::filesystem::path> shader_files(const std::filesystem::path &shader_dir);

// Contents by path; empty for missing files.
using SourceFiles = std::map<std::filesystem::path, std::optional<std::string>>;

// Polls the files ten times a second, so that other machines' writes are seen too.
class SourceWatch {
public:
    SourceWatch(std::filesystem::path scene, std::filesystem::path shader_dir);

    // Call before using the files: later changes count.
    void begin();

    // Also watches the scene's data files. These may exceed memory, so their state is kept instead of their contents.
    void follow(const std::set<std::filesystem::path> &data);

    bool has_data() const { return !data_.empty(); }

    // Waits until contents differ from those at begin() and have been stable for a moment, since saving takes several
    // steps; or a signal comes, or the time is over.
    bool changed(std::chrono::milliseconds timeout);

    std::vector<std::string> changed_names() const;

private:
    using Clock = std::chrono::steady_clock;

    struct Kept {
        std::optional<std::string> state;
        std::optional<std::string> contents;
    };

    void look();
    std::optional<std::string> contents_of(const std::filesystem::path &path);

    std::filesystem::path scene_;
    std::filesystem::path shader_dir_;
    std::set<std::filesystem::path> data_;
    std::map<std::filesystem::path, Kept> kept_; // read again only if the file's state has changed
    SourceFiles begun_;
    SourceFiles seen_;             // at the last look
    Clock::time_point seen_since_; // with these contents
    Clock::time_point last_look_;
};

} // namespace cli
