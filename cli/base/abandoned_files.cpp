#include "cli/base/abandoned_files.h"

#include "cli/base/file_descriptor.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fcntl.h>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace cli {
namespace {

constexpr std::string_view prefix = ".pt-";
constexpr std::string_view suffix = ".tmp";

bool is_temporary_name(std::string_view name) {
    if (!name.starts_with(prefix) || !name.ends_with(suffix) || name.size() < prefix.size() + suffix.size())
        return false;
    const std::string_view numbers = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
    const auto is_digit = [](char letter) { return letter >= '0' && letter <= '9'; };
    const std::size_t dash = numbers.find('-');
    return dash != std::string_view::npos && dash > 0 && dash + 1 < numbers.size() &&
           std::all_of(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(dash), is_digit) &&
           std::all_of(numbers.begin() + static_cast<std::ptrdiff_t>(dash) + 1, numbers.end(), is_digit);
}

} // namespace

// Short on purpose: a target's own name may already be as long as the file system allows.
std::string temporary_name(int attempt) {
    return std::string(prefix) + std::to_string(getpid()) + "-" + std::to_string(attempt) + std::string(suffix);
}

bool lock_temporary(int descriptor) {
    while (flock(descriptor, LOCK_EX) != 0 && errno == EINTR) {
    }
    struct stat status {};
    return fstat(descriptor, &status) != 0 || status.st_nlink > 0;
}

void remove_abandoned(const std::filesystem::path &folder) {
    std::error_code error;
    const std::filesystem::directory_iterator files(folder.empty() ? "." : folder, error);
    if (error)
        return;
    for (auto file = begin(files); file != end(files) && !error; file.increment(error)) {
        if (!is_temporary_name(file->path().filename().native()))
            continue;
        const FileDescriptor descriptor(open(file->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
        if (descriptor.is_open() && flock(descriptor.get(), LOCK_EX | LOCK_NB) == 0)
            unlink(file->path().c_str());
    }
}

} // namespace cli
