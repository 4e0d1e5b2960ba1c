#pragma once

#include "lib/platform/printable.h"

#include <pt/pt.h>

#include <algorithm>
#include <string>

namespace pt {

struct Log {
    pt_log_fn function = nullptr;
    void *user = nullptr;

    // Passes the lines of a message to the function. Must not throw, because drivers call it. After an exception the
    // rest of the message is lost.
    void write(int32_t level, const std::string &message) const noexcept {
        if (!function)
            return;
        try {
            for (std::string::size_type start = 0; start < message.size();) {
                const std::string::size_type end = std::min(message.find('\n', start), message.size());
                function(user, level, platform::printable(message.substr(start, end - start)).c_str());
                start = end + 1;
            }
        } catch (...) {
            return;
        }
    }

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
