// The program `pt`: turns exceptions into exit codes.
#include "cli/base/exit_code.h"
#include "cli/base/text.h"
#include "cli/program.h"
#include "lib/platform/terminal.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <string>

namespace {

int fail(cli::ExitCode code, const std::string &message) {
    cli::print_message(message);
    return static_cast<int>(code);
}

} // namespace

int main(int argument_count, char **arguments) {
    // CLI11 allocates memory in noexcept functions.
    std::set_terminate([] {
        std::fputs("pt: out of memory, or an internal error\n", stderr);
        std::_Exit(static_cast<int>(cli::ExitCode::internal));
    });
    platform::prepare_streams();
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
    // An earlier failure takes precedence, for example the signal of a closed terminal.
    if (!std::cout.flush()) {
        const int output_code = fail(cli::ExitCode::file, "cannot write to standard output");
        return code == 0 ? output_code : code;
    }
    return code;
}
