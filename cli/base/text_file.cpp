#include "cli/base/text_file.h"

#include "cli/base/atomic_file.h"
#include "cli/base/exit_code.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace cli {
namespace {

[[noreturn]] void fail(const std::string &path) {
    throw Failure(ExitCode::file, "cannot read " + path + ": " + std::generic_category().message(errno));
}

// By its byte order mark; or by every other byte being 0, for the first two characters of JSON are ASCII (RFC 4627,
// section 3).
bool is_utf16(std::string_view contents) {
    if (contents.starts_with("\xff\xfe") || contents.starts_with("\xfe\xff"))
        return true;
    const auto has_zeros = [&](std::size_t first) {
        return contents[first] == '\0' && contents[first + 2] == '\0' && contents[1 - first] != '\0' &&
               contents[3 - first] != '\0';
    };
    return contents.size() >= 4 && (has_zeros(0) || has_zeros(1));
}

// size: as it is expected, so that large files are not moved while they grow.
std::string read_all(int descriptor, const std::string &name, std::size_t size) {
    constexpr std::size_t block = std::size_t{1} << 20;
    std::string text;
    text.reserve(size + block);
    for (;;) {
        const std::size_t used = text.size();
        text.resize(used + block);
        const ssize_t count = read(descriptor, text.data() + used, block);
        if (count < 0 && errno != EINTR)
            fail(name);
        text.resize(used + static_cast<std::size_t>(count < 0 ? 0 : count));
        if (count == 0)
            return text;
    }
}

} // namespace

// System calls and not a stream: a stream opens a directory without complaint and keeps no reason for a failed read.
std::string read_file(const std::string &path) {
    const FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.is_open())
        fail(path);
    struct stat status;
    const bool is_file = fstat(file.get(), &status) == 0 && S_ISREG(status.st_mode);
    return read_all(file.get(), path, is_file ? static_cast<std::size_t>(status.st_size) : 0);
}

std::string read_standard_input() {
    return read_all(STDIN_FILENO, "standard input", 0);
}

std::string_view require_text(std::string_view contents, const std::string &path) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; // of UTF-8
    if (is_utf16(contents))
        throw Failure(ExitCode::scene, path + ": is UTF-16: save it as UTF-8");
    if (const std::size_t zero = contents.find('\0'); zero != std::string_view::npos) {
        throw Failure(ExitCode::scene,
                      path + ":" + line_and_column(contents.substr(0, zero)) + ": a NUL byte: this is not a text file");
    }
    contents.remove_prefix(contents.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
    return contents;
}

std::string line_and_column(std::string_view before) {
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t line_start = before.rfind('\n') + 1; // npos + 1 = 0: the first line
    return std::to_string(line) + ":" + std::to_string(before.size() - line_start + 1);
}

} // namespace cli
