#include "cli/base/directory_events.h"

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

constexpr std::chrono::milliseconds polled_interval{250};
// A directory in which others are busy must not keep this program busy.
constexpr std::chrono::milliseconds least_interval{20};

// The directory, or the nearest of its parents that exists: its appearance is an event there.
std::filesystem::path nearest_existing(std::filesystem::path directory) {
    std::error_code ignored;
    while (!std::filesystem::is_directory(directory, ignored) && directory.has_relative_path())
        directory = directory.parent_path();
    return directory.empty() ? "." : directory;
}

// Whether a descriptor has something to read before the end; a signal ends the wait.
bool poll_until(pollfd *descriptors, nfds_t count, std::chrono::steady_clock::time_point end) {
    const auto milliseconds = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    return poll(descriptors, count, std::max(static_cast<int>(milliseconds.count()), 0)) > 0;
}

} // namespace

DirectoryEvents::DirectoryEvents(Method method, std::chrono::milliseconds notified_interval) :
    notifications_(method == Method::notified ? inotify_init1(IN_NONBLOCK | IN_CLOEXEC) : -1),
    notified_interval_(notified_interval) {}

void DirectoryEvents::watch(const std::filesystem::path &directory) {
    if (!notifications_.is_open())
        return;
    // Watching a directory again gives the same watch. If the system has none left, everything is polled.
    const int watch = inotify_add_watch(notifications_.get(), nearest_existing(directory).c_str(), events);
    if (watch < 0 && errno != ENOENT)
        notifications_.close();
}

bool DirectoryEvents::wait(std::chrono::milliseconds timeout) {
    const Clock::time_point end = Clock::now() + timeout;
    const Clock::time_point next_look = last_look_ + (notifications_.is_open() ? notified_interval_ : polled_interval);
    const Clock::time_point earliest_look = last_look_ + least_interval;
    pollfd descriptor{notifications_.get(), POLLIN, 0}; // a negative one is ignored
    poll_until(nullptr, 0, std::min(earliest_look, end));
    if (Clock::now() < earliest_look)
        return false;
    const bool told = poll_until(&descriptor, 1, std::min(next_look, end));
    if (!told && Clock::now() < next_look)
        return false;
    last_look_ = Clock::now();
    read_notifications();
    return true;
}

// They are thrown away: the caller looks at every file, whatever they say.
void DirectoryEvents::read_notifications() {
    alignas(inotify_event) std::array<char, 4096> buffer;
    while (notifications_.is_open() && read(notifications_.get(), buffer.data(), buffer.size()) > 0) {
    }
}

} // namespace cli
