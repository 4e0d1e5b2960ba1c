// The files that a picture is made from (the scene, its data, and the kernels), and whether they have changed since it
// was begun.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace cli {

// The GLSL files in a folder and its subfolders; none if its name is empty.
std::set<std::filesystem::path> shader_files(const std::filesystem::path &shader_dir);

// Contents by path; nothing for a file that does not exist.
using SourceFiles = std::map<std::filesystem::path, std::optional<std::string>>;

// Looks at the files ten times a second, and so sees what other machines write, too.
class SourceWatch {
public:
    SourceWatch(std::filesystem::path scene, std::filesystem::path shader_dir);

    // The files are about to be used as they are now: later changes count.
    void begin();

    // From now on also watches these files, from which the scene takes its spheres. They may be larger than memory, so
    // their state is kept instead of their contents; it changes when they are written.
    void follow(const std::set<std::filesystem::path> &data);

    bool has_data() const { return !data_.empty(); }

    // Whether contents differ from those at begin(), and have been stable for a moment, since saving takes several
    // steps. Waits until that is so, a signal comes or the time is over.
    bool changed(std::chrono::milliseconds timeout);

    // The names of the files that differ.
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
    std::map<std::filesystem::path, Kept> kept_; // contents, read again only if the file's state has changed
    SourceFiles begun_;
    SourceFiles seen_;             // at the last look
    Clock::time_point seen_since_; // with these contents
    Clock::time_point last_look_;
};

} // namespace cli
