#include "cli/base/atomic_file.h"

#include "cli/base/exit_code.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>

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

// The kernel's rule for protected symbolic links (proc_sys_fs(5)), which it cannot apply here because it does not
// follow them: where everybody may put links that nobody else can remove, only those of the user and of the folder's
// owner count. Another user's cannot be put in their place between this and the reading of the link.
bool may_follow(const std::filesystem::path &link, const struct stat &of_link) {
    constexpr mode_t open_to_all = S_ISVTX | S_IWOTH;
    struct stat folder {};
    return stat(link.has_parent_path() ? link.parent_path().c_str() : ".", &folder) == 0 &&
           ((folder.st_mode & open_to_all) != open_to_all || of_link.st_uid == geteuid() ||
            of_link.st_uid == folder.st_uid);
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

AtomicFile::AtomicFile(const std::string &path) : path_(path), target_(target_of(path)), file_(create_temporary()) {}

AtomicFile::~AtomicFile() {
    if (file_.is_open())
        unlink(temporary_.c_str());
}

std::filesystem::path AtomicFile::target_of(const std::string &path) {
    constexpr int most_links = 40; // Linux follows no more (path_resolution(7))
    std::filesystem::path target = path;
    struct stat status {};
    for (int i = 0; i < most_links && lstat(target.c_str(), &status) == 0 && S_ISLNK(status.st_mode); ++i) {
        if (!may_follow(target, status)) {
            throw Failure(ExitCode::file,
                          "cannot write " + path + ": the link " + target.string() +
                              " is another user's, in a folder where everybody may write; only your own "
                              "links and those of the folder's owner are followed there");
        }
        std::error_code error;
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
        if (errno == ENOENT)
            return;
        fail(errno);
    }
    if (S_ISDIR(status.st_mode))
        fail(EISDIR);
    if (!S_ISREG(status.st_mode))
        throw Failure(ExitCode::file, "cannot write " + path_ + ": not a regular file");
    if (access(target_.c_str(), W_OK) != 0)
        fail(errno);
}

FileDescriptor AtomicFile::create_temporary() {
    constexpr mode_t permissions = 0666; // less those that the user's umask takes away
    refuse_unsuitable_target();
    for (int attempt = 0;; ++attempt) {
        temporary_ = target_.parent_path() / temporary_name(attempt);
        const int descriptor = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, permissions);
        if (descriptor >= 0 && lock_temporary(descriptor))
            return FileDescriptor(descriptor);
        if (descriptor >= 0)
            ::close(descriptor);
        else if (errno != EEXIST)
            fail(errno);
    }
}

void AtomicFile::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(file_.get(), bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR)
            fail(errno);
        bytes = bytes.subspan(static_cast<std::size_t>(count < 0 ? 0 : count));
    }
}

void AtomicFile::commit() {
    struct stat status {};
    if (lstat(target_.c_str(), &status) == 0 && S_ISREG(status.st_mode))
        fchmod(file_.get(), status.st_mode & 0777); // a replaced file keeps its permissions where possible
    // The data have to be on the disk before the name is: otherwise a crash could leave an empty file in its place.
    if (fsync(file_.get()) != 0 || std::rename(temporary_.c_str(), target_.c_str()) != 0)
        fail(errno);
    file_.close();
}

} // namespace cli
