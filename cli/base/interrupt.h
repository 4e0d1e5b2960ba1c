// SIGINT, SIGTERM and SIGHUP (which a closing terminal sends) set a flag that the rendering looks at.
#pragma once

#include <string>

namespace cli {

// From now on the first such signal is only noted; a second one ends the program at once, should a driver hang.
void catch_interrupts();

// Number of the signal that came; 0 if none did.
int interrupt_signal();

// "SIGINT"
std::string interrupt_name();

} // namespace cli
