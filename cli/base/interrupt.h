// Signals as flags: SIGINT, SIGTERM and SIGHUP end a rendering, SIGUSR1 requests a preview.
#pragma once

#include <string>

namespace cli {

// A second ending signal, at least a second later, ends the program at once, in case a driver hangs.
void catch_signals();

// During its lifetime a signal ends the program at once.
class EndAtOnce {
public:
    EndAtOnce();
    EndAtOnce(const EndAtOnce &) = delete;
    EndAtOnce &operator=(const EndAtOnce &) = delete;
    ~EndAtOnce();
};

int interrupt_signal();

std::string interrupt_name();

bool has_picture_request();
void forget_picture_request();

} // namespace cli
