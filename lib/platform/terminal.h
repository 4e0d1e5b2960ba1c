// The standard streams, and the signals that come from terminals.
#pragma once

#include <cstddef>

namespace platform {

// Bytes go through as they are, no file that is opened later gets the number of a stream that is closed, and a file
// beyond the limit of its size does not end the process. Call it before any file is opened.
void prepare_streams();

bool is_terminal(int stream);

// Width of the terminal on stderr; 0 if it does not say.
std::size_t terminal_columns();

// Numbers as POSIX has them, on every system.
enum Signal { hangup = 1, interruption = 2, termination = 15 };

// From now on end is called for a signal that asks this process to end, and does it at once if that returns true.
// picture is called for SIGUSR1, where there is one. Both are called while threads are stopped anywhere, or beside
// them.
void catch_signals(bool (*end)(int signal), void (*picture)());

} // namespace platform
