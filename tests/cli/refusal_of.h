#pragma once

#include "cli/base/exit_code.h"
#include "lib/base/error.h"

#include <string>

struct Refusal {
    cli::ExitCode code = cli::ExitCode::done;
    std::string message;
};

template <typename Call>
Refusal refusal_of(const Call &call) {
    try {
        call();
    } catch (const cli::Failure &failure) {
        return {failure.code(), failure.what()};
    } catch (const pt::Error &error) {
        return {cli::exit_code_of(error.code()), error.what()};
    }
    return {};
}
