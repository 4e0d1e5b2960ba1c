// Owns the waiting for something to happen in directories: by inotify, or at intervals where there is none.
// Called by source_watch.
#pragma once

#include "cli/base/file_descriptor.h"

#include <chrono>
#include <filesystem>

namespace cli {

class DirectoryEvents {
public:
    enum class Method {
        notified, // by inotify, if the system has some left; changes that another machine makes are not told, so that there
                  // is a look at intervals too
        polled // a look four times a second
    };

    explicit DirectoryEvents(Method method = Method::notified,
                             std::chrono::milliseconds notified_interval = std::chrono::seconds{2});

    // What is in it, not in directories below. To be called again after every event: a directory may have been
    // replaced. One that is not there is told of once it is.
    void watch(const std::filesystem::path &directory);

    // Waits until something may have happened, or for so long, or until a signal comes. Returns whether something may
    // have. Anything of old counts, too: what is to be known of the directories is to be read after watch().
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
