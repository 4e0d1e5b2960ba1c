#include "lib/platform/file.h"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace platform {
namespace {

namespace fs = std::filesystem;

bool is_regular(const struct stat &status) {
    return S_ISREG(status.st_mode);
}

} // namespace

void close_file(int descriptor) {
    close(descriptor);
}

int open_to_read(const fs::path &path) {
    return open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

int create_file(const fs::path &path) {
    constexpr mode_t permissions = 0666; // reduced by the umask
    return open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, permissions);
}

std::ptrdiff_t read_some(int descriptor, std::span<char> bytes) {
    for (;;)
        if (const ssize_t count = read(descriptor, bytes.data(), bytes.size()); count >= 0 || errno != EINTR)
            return count;
}

std::ptrdiff_t write_some(int descriptor, std::span<const std::byte> bytes) {
    for (;;)
        if (const ssize_t count = write(descriptor, bytes.data(), bytes.size()); count >= 0 || errno != EINTR)
            return count;
}

bool lock_created(int descriptor) {
    while (flock(descriptor, LOCK_EX) != 0 && errno == EINTR) {
    }
    struct stat status {};
    return fstat(descriptor, &status) != 0 || status.st_nlink > 0;
}

void remove_abandoned(const fs::path &path) {
    const FileDescriptor descriptor(open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (descriptor.is_open() && flock(descriptor.get(), LOCK_EX | LOCK_NB) == 0)
        unlink(path.c_str());
}

bool rename_written(int descriptor, const fs::path &from, const fs::path &to) {
    struct stat status {};
    if (lstat(to.c_str(), &status) == 0 && is_regular(status))
        fchmod(descriptor, status.st_mode & 0777); // fails on file systems without permissions
    return fsync(descriptor) == 0 && std::rename(from.c_str(), to.c_str()) == 0;
}

std::optional<std::uint64_t> regular_size(int descriptor) {
    struct stat status {};
    return fstat(descriptor, &status) == 0 && is_regular(status) ? std::optional<std::uint64_t>(status.st_size)
                                                                 : std::nullopt;
}

std::optional<std::string> file_state(const fs::path &path) {
    struct stat status {};
    std::error_code error;
    const fs::file_time_type written = fs::last_write_time(path, error);
    if (error || stat(path.c_str(), &status) != 0 || !is_regular(status))
        return std::nullopt;
    return std::to_string(status.st_size) + " bytes at " +
           std::to_string(duration_cast<std::chrono::nanoseconds>(written.time_since_epoch()).count()) + " in " +
           std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
}

bool may_write(const fs::path &path) {
    return access(path.c_str(), W_OK) == 0;
}

// The rule of the Linux kernel (protected_symlinks, proc_sys_fs(5)): in a folder like /tmp, only links that belong to
// the user or to the folder's owner are safe.
bool may_follow(const fs::path &link) {
    constexpr mode_t open_to_all = S_ISVTX | S_IWOTH;
    struct stat of_link {};
    struct stat folder {};
    return lstat(link.c_str(), &of_link) == 0 &&
           stat(link.has_parent_path() ? link.parent_path().c_str() : ".", &folder) == 0 &&
           ((folder.st_mode & open_to_all) != open_to_all || of_link.st_uid == geteuid() ||
            of_link.st_uid == folder.st_uid);
}

} // namespace platform
