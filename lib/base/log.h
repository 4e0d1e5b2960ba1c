// The caller's log function. Held by Renderer and the Vulkan instance, which write to it.
#pragma once

#include <pt/pt.h>

#include <algorithm>
#include <string>

namespace pt {

struct Log {
    pt_log_fn function = nullptr;
    void *user = nullptr;

    // Passes on a message line by line. Never throws, whatever the function does: drivers and layers call this, and
    // no exception may unwind their frames. A line that cannot be delivered is dropped.
    void write(int32_t level, const std::string &message) const noexcept {
        if (!function)
            return;
        try {
            for (std::string::size_type start = 0; start < message.size();) {
                const std::string::size_type end = std::min(message.find('\n', start), message.size());
                function(user, level, message.substr(start, end - start).c_str());
                start = end + 1;
            }
        } catch (...) {
            return;
        }
    }

    // Passes on what message() returns, which is called only if there is a log function. Nothing depends on such a
    // message: if there is no memory for it, it is dropped.
    template <typename Message>
    void info(Message &&message) const noexcept {
        if (!function)
            return;
        try {
            write(PT_LOG_INFO, message());
        } catch (...) {
            return;
        }
    }
};

} // namespace pt
