// The files that a picture is made of (the scene, its data, and the kernels), and whether they have changed since it
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

// GLSL files in that folder and in those within it; none if its name is empty.
std::set<std::filesystem::path> shader_files(const std::filesystem::path &shader_dir);

// Contents by path; nothing for a file that does not exist.
using SourceFiles = std::map<std::filesystem::path, std::optional<std::string>>;

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

    // Whether their contents differ from then, and have been the same for a moment: saving takes some steps. Waits for
    // so long at the most, until there is something to be told or a signal comes.
    bool changed(std::chrono::milliseconds timeout);

    // Those that differ.
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
    std::map<std::filesystem::path, Kept> kept_; // read again only when their state is another
    SourceFiles begun_;
    SourceFiles seen_;             // at the last look
    Clock::time_point seen_since_; // with these contents
    Clock::time_point last_look_;
};

} // namespace cli
