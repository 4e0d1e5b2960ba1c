#include "cli/base/atomic_file.h"

#include "cli/base/abandoned_files.h"
#include "cli/base/exit_code.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace cli {

AtomicFile::AtomicFile(const std::string &path) : path_(path), target_(target_of(path)), file_(create_temporary()) {}

AtomicFile::~AtomicFile() {
    if (file_.is_open()) {
        unlink(temporary_.c_str());
    }
}

std::filesystem::path AtomicFile::target_of(const std::string &path) {
    constexpr int most_links = 40; // Linux follows no more (path_resolution(7))
    std::error_code error;
    std::filesystem::path target = path;
    for (int i = 0; i < most_links && std::filesystem::is_symlink(target, error); ++i) {
        target = target.parent_path() / std::filesystem::read_symlink(target, error);
    }
    return target;
}

void AtomicFile::check_writable(const std::string &path) {
    remove_abandoned(target_of(path).parent_path());
    const AtomicFile probe(path);
}

void AtomicFile::fail(int error) const {
    throw Failure(ExitCode::file, "cannot write " + path_ + ": " + std::generic_category().message(error));
}

// A rename would replace a file that the user may not write, or a device by a regular file, without complaint.
void AtomicFile::refuse_unsuitable_target() const {
    struct stat status {};
    if (stat(target_.c_str(), &status) != 0) {
        if (errno == ENOENT) {
            return;
        }
        fail(errno);
    }
    if (S_ISDIR(status.st_mode)) {
        fail(EISDIR);
    }
    if (!S_ISREG(status.st_mode)) {
        throw Failure(ExitCode::file, "cannot write " + path_ + ": not a regular file");
    }
    if (access(target_.c_str(), W_OK) != 0) {
        fail(errno);
    }
}

FileDescriptor AtomicFile::create_temporary() {
    constexpr mode_t permissions = 0666; // less those that the user's umask takes away
    refuse_unsuitable_target();
    for (int attempt = 0;; ++attempt) {
        temporary_ = target_.parent_path() / temporary_name(attempt);
        const int descriptor = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, permissions);
        if (descriptor >= 0 && lock_temporary(descriptor)) {
            return FileDescriptor(descriptor);
        }
        if (descriptor >= 0) {
            ::close(descriptor);
        } else if (errno != EEXIST) {
            fail(errno);
        }
    }
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(file_.get(), bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR) {
            fail(errno);
        }
        bytes = bytes.subspan(static_cast<std::size_t>(count < 0 ? 0 : count));
    }
}

void AtomicFile::commit() {
    struct stat status {};
    if (stat(target_.c_str(), &status) == 0) {
        fchmod(file_.get(), status.st_mode & 07777); // a replaced file keeps its permissions where possible
    }
    // The data have to be on the disk before the name is: otherwise a crash could leave an empty file in its place.
    if (fsync(file_.get()) != 0 || std::rename(temporary_.c_str(), target_.c_str()) != 0) {
        fail(errno);
    }
    file_.close();
}

} // namespace cli
