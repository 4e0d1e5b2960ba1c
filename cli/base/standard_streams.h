// Keeps the numbers of closed standard streams from going to other files: what is printed would be written into them.
#pragma once

#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

namespace cli {

// To be called before any file is opened. A stream that is closed fails afterwards as it did before, with EBADF.
inline void occupy_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
            // The lowest number that is free, which is this one: those before it are in use.
            static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
        }
    }
}

} // namespace cli
