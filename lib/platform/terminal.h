#pragma once

#include <cstddef>

namespace platform {

// Must be called before any file is opened. Makes streams binary, prevents files from getting the number of a closed
// stream, and makes writes beyond the file size limit fail instead of ending the process.
void prepare_streams();

bool is_terminal(int stream);

std::size_t terminal_columns();

enum Signal { hangup = 1, interruption = 2, termination = 15 };

// Calls `end` for signals that ask the process to end. If `end` returns true, the process ends at once. Calls `picture`
// for SIGUSR1. Both functions may interrupt any thread or run on another one.
void catch_signals(bool (*end)(int signal), void (*picture)());

} // namespace platform
