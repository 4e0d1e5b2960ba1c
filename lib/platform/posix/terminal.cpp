#include "lib/platform/terminal.h"

#include "lib/platform/file.h"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace platform {
namespace {

static_assert(hangup == SIGHUP && interruption == SIGINT && termination == SIGTERM);

bool (*end_of_process)(int) = nullptr;
void (*picture_request)() = nullptr;

extern "C" void note_end(int signal) {
    if (!end_of_process(signal))
        return;
    std::signal(signal, SIG_DFL);
    raise(signal); // arrives when this handler returns
}

extern "C" void note_picture_request(int) {
    picture_request();
}

void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

} // namespace

void prepare_streams() {
    for (const int stream : {standard_input, standard_output, standard_error}) {
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
            // open() returns the lowest free number, which is the number of the closed stream. The wrong mode makes
            // reads and writes fail with EBADF, as on a closed stream.
            static_cast<void>(open("/dev/null", stream == standard_input ? O_WRONLY : O_RDONLY));
        }
    }
    std::signal(SIGXFSZ, SIG_IGN); // a write beyond the limit then fails with EFBIG
}

bool is_terminal(int stream) {
    return isatty(stream) == 1;
}

std::size_t terminal_columns() {
    winsize size{};
    return ioctl(standard_error, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

void catch_signals(bool (*end)(int), void (*picture)()) {
    end_of_process = end;
    picture_request = picture;
    for (const int signal : {interruption, termination, hangup}) {
        struct sigaction old {};
        sigaction(signal, nullptr, &old);
        if (old.sa_handler != SIG_IGN) // ignored for background jobs and by nohup
            handle(signal, &note_end);
    }
    handle(SIGUSR1, &note_picture_request);
}

} // namespace platform
