// Owns SIGINT and SIGTERM: they set a flag that the rendering reads.
// Called by render_command and bench_command.
#pragma once

namespace cli {

// From now on the first such signal is only noted; a second one ends the program at once, should a driver hang.
void catch_interrupts();

// Number of the signal that came; 0 if none did.
int interrupt_signal();

} // namespace cli
