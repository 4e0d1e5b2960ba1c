// Tells whether the files of a picture have changed since it was begun.
#pragma once

#include "cli/base/directory_events.h"
#include "cli/scene/source_files.h"

#include <chrono>
#include <set>
#include <string>
#include <vector>

namespace cli {

class SourceWatch {
public:
    SourceWatch(std::filesystem::path scene, std::filesystem::path shader_dir,
                DirectoryEvents::Method method = DirectoryEvents::Method::notified);

    // The files are to be used as they are now: changes from here on count.
    void begin();

    // What the scene takes its particles from, from here on: these files, as they are now.
    void follow(const std::set<std::filesystem::path> &data);

    bool has_data() const { return !data_.empty(); }

    // The scene and these files, as they were then.
    SourceFiles scene() const;

    // Whether their contents differ from then, and have been the same for a moment: saving takes some steps. Waits
    // for so long at the most, until something happens in their directories or a signal comes.
    bool changed(std::chrono::milliseconds timeout);

    // Those that differ.
    std::vector<std::string> changed_names() const;

private:
    using Clock = std::chrono::steady_clock;

    void look();

    std::filesystem::path scene_;
    std::filesystem::path shader_dir_;
    std::set<std::filesystem::path> data_;
    DirectoryEvents events_;
    SourceFiles begun_;
    SourceFiles seen_;             // at the last look
    Clock::time_point seen_since_; // with these contents
};

} // namespace cli
