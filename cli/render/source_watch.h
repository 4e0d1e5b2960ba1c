// Watches scene, data and kernels for changes.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cli {

// Subfolders included. Empty without a name.
std::set<std::filesystem::path> shader_files(const std::filesystem::path &shader_dir);

// Empty contents: a missing file.
using SourceFiles = std::map<std::filesystem::path, std::optional<std::string>>;

// Polls ten times a second, which also sees other machines' writes.
class SourceWatch {
public:
    SourceWatch(std::filesystem::path scene, std::filesystem::path shader_dir);

    // Call before using the files.
    void begin();

    // Also watches data files. They may exceed memory, so only their state is kept.
    void follow(const std::set<std::filesystem::path> &data);

    bool has_data() const { return !data_.empty(); }

    // Waits for contents that differ from begin()'s and are stable (saving takes several steps), a signal, or the
    // timeout.
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
    std::map<std::filesystem::path, Kept> kept_; // read again if the file's state changed
    SourceFiles begun_;
    SourceFiles seen_;
    Clock::time_point seen_since_;
    Clock::time_point last_look_;
};

} // namespace cli
