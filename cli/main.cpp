// The program `pt`: what surrounds its command. Turns every exception into an exit code.
#include "cli/base/exit_code.h"
#include "cli/base/text.h"
#include "cli/program.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <iostream>
#include <new>
#include <string>
#include <unistd.h>

namespace {

// Keeps the numbers of closed standard streams from being given to other files, into which output would then be
// written. Call it before any file is opened. A closed stream still fails with EBADF afterwards.
void occupy_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
            // open() takes the lowest free number. That is this stream's, since those below it are in use.
            static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
        }
    }
}

int fail(cli::ExitCode code, const std::string &message) {
    cli::print_message(message);
    return static_cast<int>(code);
}

} // namespace

int main(int argument_count, char **arguments) {
    // CLI11 allocates memory in functions that it has declared noexcept.
    std::set_terminate([] {
        std::fputs("pt: out of memory, or an internal error\n", stderr);
        std::_Exit(static_cast<int>(cli::ExitCode::internal));
    });
    occupy_closed_streams();
    int code = 0;
    try {
        code = cli::run_program(argument_count, arguments);
    } catch (const cli::Failure &failure) {
        return fail(failure.code(), failure.what());
    } catch (const std::bad_alloc &) {
        return fail(cli::ExitCode::internal, "out of memory");
    } catch (const std::exception &error) {
        return fail(cli::ExitCode::internal, std::string("internal error: ") + error.what());
    }
    // An earlier failure takes precedence, for example the signal of a terminal that was closed.
    if (!std::cout.flush()) {
        const int output_code = fail(cli::ExitCode::file, "cannot write to standard output");
        return code == 0 ? output_code : code;
    }
    return code;
}
