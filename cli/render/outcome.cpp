#include "cli/render/outcome.h"

#include "cli/base/exit_code.h"

namespace cli {

int exit_code_of(Outcome outcome, int signal) {
    switch (outcome) {
    case Outcome::not_all_written:
        return static_cast<int>(ExitCode::file);
    case Outcome::target_missed:
        return static_cast<int>(ExitCode::target_missed);
    case Outcome::timed_out:
        return static_cast<int>(ExitCode::resumable);
    case Outcome::written:
    case Outcome::interrupted:
    case Outcome::superseded:
        break;
    }
    return signal == 0 ? static_cast<int>(ExitCode::done) : exit_code_of_signal(signal);
}

} // namespace cli
