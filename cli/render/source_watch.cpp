#include "cli/render/source_watch.h"

#include "cli/base/exit_code.h"
#include "cli/base/text.h"
#include "cli/base/text_file.h"

#include <algorithm>
#include <poll.h>
#include <sstream>
#include <string_view>
#include <sys/stat.h>
#include <utility>

namespace cli {
namespace {

constexpr std::chrono::milliseconds interval{100};
constexpr std::chrono::milliseconds settling{50};

// Empty if there is no such file.
std::string state_of(const struct stat &status) {
    return concat(status.st_size, " bytes at ", status.st_mtim.tv_sec, ".", status.st_mtim.tv_nsec, " in ",
                  status.st_dev, ":", status.st_ino);
}

// Files are stamped with a clock of some milliseconds: one that was just changed may change again within the same.
bool is_fresh(const struct stat &status) {
    constexpr double tick = 0.1;
    timespec now{};
    clock_gettime(CLOCK_REALTIME, &now);
    return static_cast<double>(now.tv_sec - status.st_mtim.tv_sec) +
               1e-9 * static_cast<double>(now.tv_nsec - status.st_mtim.tv_nsec) <
           tick;
}

// The name in a line `#include "name"`, blanks allowed; empty for other lines. Lines that the preprocessor would skip
// count too: a file too many does no harm.
std::string_view included_name(std::string_view line) {
    const auto skip = [&](std::string_view word) {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        const bool found = line.starts_with(word);
        line.remove_prefix(found ? word.size() : 0);
        return found;
    };
    if (!skip("#") || !skip("include") || !skip("\""))
        return {};
    const std::size_t end = line.find('"');
    return end == std::string_view::npos ? std::string_view() : line.substr(0, end);
}

SourceFiles read_shader_files(const std::filesystem::path &shader_dir, FileCache &cache) {
    SourceFiles files;
    std::vector<std::filesystem::path> to_read;
    if (!shader_dir.empty()) {
        for (const char *kernel : {"pathtrace.comp", "fold.comp", "add.comp", "resolve.comp", "estimate.comp",
                                   "accuracy.comp", "first_hit.comp", "coverage.comp"}) {
            to_read.push_back(shader_dir / kernel);
        }
    }
    while (!to_read.empty()) {
        const std::filesystem::path path = to_read.back().lexically_normal();
        to_read.pop_back();
        const auto [file, is_new] = files.try_emplace(path);
        if (!is_new)
            continue;
        file->second = cache.contents_of(path);
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

std::optional<std::string> state_of_file(const std::filesystem::path &path) {
    struct stat status {};
    return stat(path.c_str(), &status) == 0 ? std::optional(state_of(status)) : std::nullopt;
}

} // namespace

std::optional<std::string> FileCache::contents_of(const std::filesystem::path &path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) {
        entries_.erase(path);
        return std::nullopt;
    }
    Entry &entry = entries_[path];
    const std::string state = is_fresh(status) ? "" : state_of(status);
    if (state.empty() || state != entry.state) {
        try {
            entry = {state, read_file(path.string())};
        } catch (const Failure &) {
            entry = {};
        }
    }
    return entry.contents;
}

SourceFiles read_shader_files(const std::filesystem::path &shader_dir) {
    FileCache cache;
    return read_shader_files(shader_dir, cache);
}

SourceWatch::SourceWatch(std::filesystem::path scene, std::filesystem::path shader_dir) :
    scene_(std::move(scene)),
    shader_dir_(std::move(shader_dir)) {
    begin();
}

void SourceWatch::look() {
    SourceFiles found = read_shader_files(shader_dir_, cache_);
    found.try_emplace(scene_, cache_.contents_of(scene_));
    for (const std::filesystem::path &path : data_)
        found.try_emplace(path, state_of_file(path));
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

void SourceWatch::follow(const std::set<std::filesystem::path> &data) {
    for (const std::filesystem::path &path : data_)
        if (!data.contains(path))
            begun_.erase(path);
    data_ = data;
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
    const auto end = Clock::now() + timeout;
    const auto next_look = last_look_ + (seen_ != begun_ ? settling : interval);
    const auto wait = std::chrono::ceil<std::chrono::milliseconds>(std::min(next_look, end) - Clock::now());
    if (wait.count() > 0)
        poll(nullptr, 0, static_cast<int>(wait.count())); // which a signal ends
    if (Clock::now() >= next_look)
        look();
    return seen_ != begun_ && Clock::now() - seen_since_ >= settling;
}

std::vector<std::string> SourceWatch::changed_names() const {
    const auto text_in = [](const SourceFiles &files, const std::filesystem::path &path) {
        const auto found = files.find(path);
        return found == files.end() ? std::nullopt : found->second;
    };
    std::vector<std::string> names;
    SourceFiles all = begun_;
    all.insert(seen_.begin(), seen_.end());
    for (const auto &[path, contents] : all)
        if (text_in(begun_, path) != text_in(seen_, path))
            names.push_back(path.string());
    return names;
}

} // namespace cli
