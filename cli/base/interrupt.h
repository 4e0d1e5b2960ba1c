// Signals set flags that the rendering looks at: SIGINT, SIGTERM and SIGHUP (which a closing terminal sends) end it,
// SIGUSR1 asks for the picture so far.
#pragma once

#include <string>

namespace cli {

// From now on the first signal that ends a rendering is only noted. One that comes a second or more later ends the
// program at once, in case a driver hangs. SIGUSR1 is noted any number of times; before this call it ends the program.
void catch_signals();

// Number of the signal that came; 0 if none did.
int interrupt_signal();

// "SIGINT"
std::string interrupt_name();

// Whether a SIGUSR1 has come since the last forget_picture_request().
bool has_picture_request();
void forget_picture_request();

} // namespace cli
