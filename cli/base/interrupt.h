// Signals set flags: SIGINT, SIGTERM and SIGHUP (a closing terminal's) end a rendering, SIGUSR1 requests the picture so
// far.
#pragma once

#include <string>

namespace cli {

// The first ending signal is noted; another one, a second or more later, ends the program at once, in case a driver
// hangs. SIGUSR1 ends the program before this call.
void catch_signals();

// While one lives, a signal ends the program at once: for waits in which nothing can be lost.
class EndAtOnce {
public:
    EndAtOnce();
    EndAtOnce(const EndAtOnce &) = delete;
    EndAtOnce &operator=(const EndAtOnce &) = delete;
    ~EndAtOnce();
};

// 0: none.
int interrupt_signal();

// "SIGINT"
std::string interrupt_name();

// Since the last forget_picture_request().
bool has_picture_request();
void forget_picture_request();

} // namespace cli
