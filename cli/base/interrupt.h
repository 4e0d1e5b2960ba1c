// Flags set by signals: SIGINT, SIGTERM and SIGHUP end a rendering, SIGUSR1 requests a preview.
#pragma once

#include <string>

namespace cli {

// Notes the first ending signal. Another one a second later ends the program at once, in case a driver hangs.
void catch_signals();

// While an object lives, a signal ends the program at once.
class EndAtOnce {
public:
    EndAtOnce();
    EndAtOnce(const EndAtOnce &) = delete;
    EndAtOnce &operator=(const EndAtOnce &) = delete;
    ~EndAtOnce();
};

// 0: none.
int interrupt_signal();

std::string interrupt_name();

// Since the last forget_picture_request().
bool has_picture_request();
void forget_picture_request();

} // namespace cli
