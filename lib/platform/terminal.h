// The standard streams, and signals from terminals.
#pragma once

#include <cstddef>

namespace platform {

// Call before any file is opened. Streams become binary, no file gets a closed stream's number, and exceeding the file
// size limit does not end the process.
void prepare_streams();

bool is_terminal(int stream);

// Columns of the terminal on stderr; 0 if unknown.
std::size_t terminal_columns();

// POSIX numbers, on every system.
enum Signal { hangup = 1, interruption = 2, termination = 15 };

// Calls `end` for signals that ask the process to end, which happens at once if it returns true, and `picture` for
// SIGUSR1. Both may run while threads are stopped anywhere, or beside them.
void catch_signals(bool (*end)(int signal), void (*picture)());

} // namespace platform
