#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cli {

std::set<std::filesystem::path> shader_files(const std::filesystem::path &shader_dir);

// The contents of a missing file are empty.
using SourceFiles = std::map<std::filesystem::path, std::optional<std::string>>;

// Polls ten times a second. Polling also finds changes by other machines.
class SourceWatch {
public:
    SourceWatch(std::filesystem::path scene, std::filesystem::path shader_dir);

    // Must precede the first use of the files.
    void begin();

    // Only the state of data files is kept, because the contents may exceed the memory.
    void follow(const std::set<std::filesystem::path> &data);

    bool has_data() const { return !data_.empty(); }

    // Waits for a signal, the timeout, or changed contents. These must be stable, because saving takes several steps.
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
    std::map<std::filesystem::path, Kept> kept_; // read again if a file's state has changed
    SourceFiles begun_;
    SourceFiles seen_;
    Clock::time_point seen_since_;
    Clock::time_point last_look_;
};

} // namespace cli
