#pragma once

#include <cstddef>

namespace platform {

// Call this before any file is opened. It makes streams binary, keeps files from taking the number of a closed stream,
// and lets writes beyond the file size limit fail instead of ending the process.
void prepare_streams();

bool is_terminal(int stream);

std::size_t terminal_columns();

// POSIX numbers, on every system.
enum Signal { hangup = 1, interruption = 2, termination = 15 };

// Calls `end` for signals that ask the process to end, and ends it at once if `end` returns true. Calls `picture` for
// SIGUSR1. Both may interrupt any thread anywhere, or run on another thread.
void catch_signals(bool (*end)(int signal), void (*picture)());

} // namespace platform
