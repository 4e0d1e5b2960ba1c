// Owns the reading of a whole file.
// Called by the scene file reader and source_files.
#include "text_file.h"

#include "exit_code.h"
#include "file_descriptor.h"

#include <cerrno>
#include <cstddef>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace cli {
namespace {

[[noreturn]] void fail(const std::string &path) {
    throw Failure(ExitCode::file, "cannot read " + path + ": " + std::generic_category().message(errno));
}

} // namespace

// System calls and not a stream: a stream opens a directory without complaint and keeps no reason for a failed read.
std::string read_file(const std::string &path) {
    constexpr std::size_t block = std::size_t{1} << 20;
    const FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.is_open()) {
        fail(path);
    }
    std::string text;
    for (;;) {
        const std::size_t used = text.size();
        text.resize(used + block);
        const ssize_t count = read(file.get(), text.data() + used, block);
        if (count < 0 && errno != EINTR) {
            fail(path);
        }
        text.resize(used + static_cast<std::size_t>(count < 0 ? 0 : count));
        if (count == 0) {
            return text;
        }
    }
}

} // namespace cli
