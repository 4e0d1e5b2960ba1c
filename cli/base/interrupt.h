// Owns SIGINT, SIGTERM and SIGHUP, which a terminal that goes away sends: they set a flag that the rendering reads.
// Called by render_command and bench_command.
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
