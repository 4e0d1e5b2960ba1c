// Signals set flags that the rendering looks at: SIGINT, SIGTERM and SIGHUP (which a closing terminal sends) end it,
// SIGUSR1 asks for the picture so far.
#pragma once

#include <string>

namespace cli {

// From now on the first signal that ends a rendering is only noted; one that comes a second or more after it ends the
// program at once, should a driver hang. SIGUSR1 is noted any number of times; before, it ends the program.
void catch_signals();

// Number of the signal that came; 0 if none did.
int interrupt_signal();

// "SIGINT"
std::string interrupt_name();

// Whether a SIGUSR1 has come that forget_picture_request() has not taken away.
bool has_picture_request();
void forget_picture_request();

} // namespace cli
