#include "cli/render/source_watch.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace cli {
namespace {

constexpr std::chrono::milliseconds settling{50};

std::filesystem::path directory_of(const std::filesystem::path &file) {
    return file.has_parent_path() ? file.parent_path() : ".";
}

// Those of the files' names, and of what symbolic links among them point to.
std::set<std::filesystem::path> directories_of(const SourceFiles &files) {
    std::set<std::filesystem::path> directories;
    for (const auto &[path, contents] : files) {
        std::error_code error;
        const std::filesystem::path target = std::filesystem::canonical(path, error);
        directories.insert(directory_of(path));
        if (!error)
            directories.insert(directory_of(target));
    }
    return directories;
}

} // namespace

SourceWatch::SourceWatch(std::filesystem::path scene, std::filesystem::path shader_dir,
                         DirectoryEvents::Method method) :
    scene_(std::move(scene)),
    shader_dir_(std::move(shader_dir)),
    events_(method) {
    begin();
}

// Watches first and reads then, so that no change is missed; again if what was read may name other directories.
void SourceWatch::look() {
    for (bool is_new = true; is_new;) {
        for (const std::filesystem::path &directory : directories_of(seen_))
            events_.watch(directory);
        SourceFiles found = read_source_files(scene_, shader_dir_, data_);
        is_new = found != seen_;
        if (is_new) {
            seen_ = std::move(found);
            seen_since_ = Clock::now();
        }
    }
}

void SourceWatch::begin() {
    look();
    begun_ = seen_;
}

void SourceWatch::follow(const std::set<std::filesystem::path> &data) {
    for (const std::filesystem::path &path : data_) {
        if (!data.contains(path)) {
            begun_.erase(path);
            seen_.erase(path);
        }
    }
    data_ = data;
    for (const std::filesystem::path &path : data_)
        seen_.try_emplace(path); // its directory is watched before it is looked at
    look();
    for (const std::filesystem::path &path : data_)
        begun_.try_emplace(path, seen_.at(path));
}

SourceFiles SourceWatch::scene() const {
    SourceFiles files{{scene_, begun_.at(scene_)}};
    for (const std::filesystem::path &path : data_)
        files.emplace(path, begun_.at(path));
    return files;
}

bool SourceWatch::changed(std::chrono::milliseconds timeout) {
    const bool unsettled = seen_ != begun_;
    if (events_.wait(unsettled ? std::min(timeout, settling) : timeout))
        look();
    return seen_ != begun_ && Clock::now() - seen_since_ >= settling;
}

std::vector<std::string> SourceWatch::changed_names() const {
    std::vector<std::string> names;
    const auto text_in = [](const SourceFiles &files, const std::filesystem::path &path) {
        const auto found = files.find(path);
        return found == files.end() ? std::nullopt : found->second;
    };
    SourceFiles all = begun_;
    all.insert(seen_.begin(), seen_.end());
    for (const auto &[path, contents] : all)
        if (text_in(begun_, path) != text_in(seen_, path))
            names.push_back(path.string());
    return names;
}

} // namespace cli
