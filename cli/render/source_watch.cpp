#include "cli/render/source_watch.h"

#include "lib/platform/file.h"
#include "lib/platform/input_file.h"

#include <algorithm>
#include <iterator>
#include <system_error>
#include <thread>
#include <utility>

namespace cli {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds interval{100};
constexpr std::chrono::milliseconds settling{50};

// A second change soon after the first may leave the file's time unchanged.
bool is_fresh(const fs::path &path) {
    std::error_code error;
    const fs::file_time_type written = fs::last_write_time(path, error);
    return error || fs::file_time_type::clock::now() - written < std::chrono::milliseconds{100};
}

} // namespace

std::set<fs::path> shader_files(const fs::path &shader_dir) {
    std::set<fs::path> files;
    std::error_code error;
    if (shader_dir.empty())
        return files;
    for (fs::recursive_directory_iterator entry(shader_dir, error), end; !error && entry != end;
         entry.increment(error)) {
        const fs::path extension = entry->path().extension();
        if (extension == ".comp" || extension == ".glsl" || extension == ".h")
            files.insert(entry->path().lexically_normal());
    }
    return files;
}

std::optional<std::string> SourceWatch::contents_of(const fs::path &path) {
    const std::optional<std::string> state = platform::file_state(path);
    Kept &kept = kept_[path];
    if (!state || is_fresh(path) || state != kept.state) {
        try {
            kept = state ? Kept{state, platform::InputFile(path).text()} : Kept{};
        } catch (const platform::InputError &) {
            kept = {};
        }
    }
    return kept.contents;
}

SourceWatch::SourceWatch(fs::path scene, fs::path shader_dir) :
    scene_(std::move(scene)),
    shader_dir_(std::move(shader_dir)) {
    begin();
}

void SourceWatch::look() {
    SourceFiles found{{scene_, contents_of(scene_)}};
    for (const fs::path &path : shader_files(shader_dir_))
        found.try_emplace(path, contents_of(path));
    for (const fs::path &path : data_)
        found.try_emplace(path, platform::file_state(path));
    last_look_ = Clock::now();
    if (found != seen_) {
        seen_ = std::move(found);
        seen_since_ = last_look_;
    }
}

void SourceWatch::begin() {
    look();
    begun_ = seen_;
}

void SourceWatch::follow(const std::set<fs::path> &data) {
    for (const fs::path &path : data_)
        if (!data.contains(path))
            begun_.erase(path);
    data_ = data;
    look();
    for (const fs::path &path : data_)
        begun_.try_emplace(path, seen_.at(path));
}

bool SourceWatch::changed(std::chrono::milliseconds timeout) {
    const auto end = Clock::now() + timeout;
    const auto next_look = last_look_ + (seen_ != begun_ ? settling : interval);
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(std::min(next_look, end) - Clock::now());
    if (wait.count() > 0)
        std::this_thread::sleep_for(wait);
    if (Clock::now() >= next_look)
        look();
    return seen_ != begun_ && Clock::now() - seen_since_ >= settling;
}

std::vector<std::string> SourceWatch::changed_names() const {
    std::vector<std::pair<const fs::path, std::optional<std::string>>> differing;
    std::ranges::set_symmetric_difference(begun_, seen_, std::back_inserter(differing));
    std::set<std::string> names;
    for (const auto &[path, contents] : differing)
        names.insert(path.string());
    return {names.begin(), names.end()};
}

} // namespace cli
