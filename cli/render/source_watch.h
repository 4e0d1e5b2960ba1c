// The files that a picture is made of (the scene, its data, and the kernels with what they include), and whether they
// have changed since it was begun.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cli {

// Contents by path; nothing for a file that does not exist. An included file is listed at both places where it is
// looked for, since it may appear at either.
using SourceFiles = std::map<std::filesystem::path, std::optional<std::string>>;

// The kernels in a folder; none if its name is empty.
SourceFiles read_shader_files(const std::filesystem::path &shader_dir);

// Contents of files, which are read again only when the time of their last change, their size or their inode is
// another.
class FileCache {
public:
    std::optional<std::string> contents_of(const std::filesystem::path &path);

private:
    struct Entry {
        std::string state;
        std::optional<std::string> contents;
    };
    std::map<std::filesystem::path, Entry> entries_;
};

// Looks at the files ten times a second: that sees what other machines write, too.
class SourceWatch {
public:
    SourceWatch(std::filesystem::path scene, std::filesystem::path shader_dir);

    // The files are to be used as they are now: changes from here on count.
    void begin();

    // What the scene takes its spheres from, from here on: these files, as they are now. They may be larger than
    // memory: what stands for them here changes when they are written.
    void follow(const std::set<std::filesystem::path> &data);

    bool has_data() const { return !data_.empty(); }

    // The scene and these files, as they were then.
    SourceFiles scene() const;

    // Whether their contents differ from then, and have been the same for a moment: saving takes some steps. Waits for
    // so long at the most, until there is something to be told or a signal comes.
    bool changed(std::chrono::milliseconds timeout);

    // Those that differ.
    std::vector<std::string> changed_names() const;

private:
    using Clock = std::chrono::steady_clock;

    void look();

    std::filesystem::path scene_;
    std::filesystem::path shader_dir_;
    std::set<std::filesystem::path> data_;
    FileCache cache_;
    SourceFiles begun_;
    SourceFiles seen_;             // at the last look
    Clock::time_point seen_since_; // with these contents
    Clock::time_point last_look_;
};

} // namespace cli
