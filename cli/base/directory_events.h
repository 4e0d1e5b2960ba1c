// Waits until something happens in directories: by inotify, or by looking at intervals where the system has none left.
#pragma once

#include "cli/base/file_descriptor.h"

#include <chrono>
#include <filesystem>

namespace cli {

class DirectoryEvents {
public:
    enum class Method {
        // By inotify, if the system has a watch left. It does not see what other machines change, so that there is also
        // a look at intervals.
        notified,
        polled // a look four times a second
    };

    explicit DirectoryEvents(Method method = Method::notified,
                             std::chrono::milliseconds notified_interval = std::chrono::seconds{2});

    // Watches what is in the directory, but not in those below. To be called again after every event, since the
    // directory may have been replaced. If there is no such directory, its appearance is an event.
    void watch(const std::filesystem::path &directory);

    // Waits until something may have happened, the time is over or a signal comes. Returns whether something may have.
    // Events from before the call count too: read the directories after watch(), or a change is missed.
    bool wait(std::chrono::milliseconds timeout);

    Method method() const { return notifications_.is_open() ? Method::notified : Method::polled; }

private:
    using Clock = std::chrono::steady_clock;

    void read_notifications();

    FileDescriptor notifications_;
    std::chrono::milliseconds notified_interval_;
    Clock::time_point last_look_ = Clock::now();
};

} // namespace cli
