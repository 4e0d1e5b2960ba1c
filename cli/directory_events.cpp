// Owns the waiting for something to happen in directories: by inotify, or at intervals where there is none.
// Called by source_watch.
#include "directory_events.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <poll.h>
#include <sys/inotify.h>
#include <system_error>

namespace cli {
namespace {

// Directories and not files: editors save by writing a new file and renaming it, which ends a watch on the old one.
constexpr std::uint32_t events =
    IN_CLOSE_WRITE | IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO | IN_ATTRIB | IN_DELETE_SELF | IN_MOVE_SELF;

constexpr std::chrono::milliseconds notified_interval{2000};
constexpr std::chrono::milliseconds polled_interval{250};

// Where the directory, or the next of its parents, would appear.
std::filesystem::path nearest_existing(std::filesystem::path directory) {
    std::error_code ignored;
    while (!std::filesystem::is_directory(directory, ignored) && directory.has_relative_path()) {
        directory = directory.parent_path();
    }
    return directory.empty() ? "." : directory;
}

} // namespace

DirectoryEvents::DirectoryEvents(Method method) :
    notifications_(method == Method::notified ? inotify_init1(IN_NONBLOCK | IN_CLOEXEC) : -1) {}

void DirectoryEvents::watch(const std::filesystem::path &directory) {
    if (!notifications_.is_open()) {
        return;
    }
    // A second watch on the same directory is the first one. Where the system has none left, all is polled.
    const int watch = inotify_add_watch(notifications_.get(), nearest_existing(directory).c_str(), events);
    if (watch < 0 && errno != ENOENT) {
        notifications_.close();
    }
}

bool DirectoryEvents::wait(std::chrono::milliseconds timeout) {
    const auto interval = notifications_.is_open() ? notified_interval : polled_interval;
    const auto to_next_look = std::chrono::ceil<std::chrono::milliseconds>(last_look_ + interval - Clock::now());
    pollfd descriptor{notifications_.get(), POLLIN, 0}; // a negative one is ignored
    const auto milliseconds = std::clamp(to_next_look, std::chrono::milliseconds{0}, timeout);
    const bool told = poll(&descriptor, 1, static_cast<int>(milliseconds.count())) > 0;
    if (!told && Clock::now() < last_look_ + interval) {
        return false;
    }
    last_look_ = Clock::now();
    read_notifications();
    return true;
}

// What they say is not needed: whoever is told looks at everything.
void DirectoryEvents::read_notifications() {
    alignas(inotify_event) std::array<char, 4096> buffer;
    while (notifications_.is_open() && read(notifications_.get(), buffer.data(), buffer.size()) > 0) {
    }
}

} // namespace cli
