#pragma once

#include "lib/base/error.h"

#include <pt/pt.h>

#include <stdexcept>
#include <string>

namespace cli {

enum class ExitCode {
    done = 0,
    internal = 1, // wrong result of program, driver or device
    usage = 2,
    scene = 3,
    no_device = 4,
    device_lost = 5,
    file = 6,
    target_missed = 7,
    images_differ = 8,
    undecided = 9,  // too few samples for a verdict
    resumable = 75, // EX_TEMPFAIL of sysexits.h; schedulers retry
    signal = 128    // the signal's number is added
};

inline constexpr const char *exit_code_help =
    "Exit codes:\n"
    "  0    done\n"
    "  1    internal error, a message of the validation layer, or a failed selftest\n"
    "  2    usage: a wrong option or value\n"
    "  3    scene: the scene file, a file that it names, or a shader of --shader-dir, is not valid\n"
    "  4    no usable Vulkan device or driver\n"
    "  5    device lost; another try may succeed\n"
    "  6    a file could not be read or written\n"
    "  7    the target error was not reached, or samples that merge --spp asks for are missing; all files\n"
    "       were written\n"
    "  8    compared images differ by more than a limit, or in their light; or a step is wrong\n"
    "  9    too few samples to tell whether images show the same light\n"
    "  75   --time came first; all files were written, and --resume continues from the checkpoint\n"
    "  129  SIGHUP: the samples so far were written, if there were any, and the checkpoint\n"
    "  130  SIGINT: the same\n"
    "  143  SIGTERM: the same\n"
    "If such a signal ends a waiting --watch, the exit code is 0.";

class Failure : public std::runtime_error {
public:
    Failure(ExitCode code, const std::string &message) : std::runtime_error(message), code_(code) {}
    ExitCode code() const { return code_; }

private:
    ExitCode code_;
};

inline void refuse_if(bool is_refused, const std::string &message, ExitCode code = ExitCode::usage) {
    if (is_refused)
        throw Failure(code, message);
}

constexpr int exit_code_of_signal(int signal) {
    return static_cast<int>(ExitCode::signal) + signal;
}

constexpr ExitCode exit_code_of(pt_result result) {
    switch (result) {
    case PT_ERROR_INVALID_ARGUMENT:
    case PT_ERROR_INCOMPATIBLE:
        return ExitCode::usage;
    case PT_ERROR_INVALID_SCENE:
        return ExitCode::scene;
    case PT_ERROR_UNSUPPORTED:
    case PT_ERROR_NO_DEVICE:
    case PT_ERROR_OUT_OF_DEVICE_MEMORY:
    case PT_ERROR_SHADER:
        return ExitCode::no_device;
    case PT_ERROR_DEVICE_LOST:
        return ExitCode::device_lost;
    case PT_ERROR_FILE:
        return ExitCode::file;
    default:
        return ExitCode::internal;
    }
}

// Gives exceptions of lib/scene_file/ an exit code.
template <typename Call>
auto with_exit_code(const Call &call) {
    try {
        return call();
    } catch (const pt::Error &error) {
        throw Failure(exit_code_of(error.code()), error.what());
    }
}

} // namespace cli
