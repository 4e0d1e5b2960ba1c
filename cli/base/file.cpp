#include "cli/base/file.h"

#include "cli/base/exit_code.h"
#include "cli/base/text.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <iostream>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>

namespace cli {
namespace {

// Whether temporary_name() could have made it.
bool is_temporary_name(const std::string &name) {
    int end = 0;
    std::sscanf(name.c_str(), ".pt-%*[0-9]-%*[0-9].tmp%n", &end);
    return end > 0 && static_cast<std::size_t>(end) == name.size();
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

namespace fs = std::filesystem;

fs::path folder_of(const fs::path &path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

// Where the path leads; empty if there is no such file. A terminal may be read and written at the same time.
fs::path target_of(const NamedFile &file, bool is_input) {
    struct stat status {};
    if (file.path != standard_stream)
        return file.path;
    if (is_input)
        return fstat(STDIN_FILENO, &status) == 0 && S_ISREG(status.st_mode) ? "/dev/stdin" : "";
    return "/dev/stdout"; // whatever it leads to: two reports on one stream would be mixed up
}

// Whether they are one file, or would be once written: then they have the same folder and the same name in it.
bool is_same(const fs::path &one, const fs::path &other) {
    std::error_code error;
    if (one.empty() || other.empty() || one == other)
        return !one.empty() && one == other;
    if (fs::exists(one, error) || fs::exists(other, error))
        return fs::equivalent(one, other, error);
    const fs::path first = AtomicFile::target_of(one);
    const fs::path second = AtomicFile::target_of(other);
    return first.filename() == second.filename() && fs::equivalent(folder_of(first), folder_of(second), error);
}

[[noreturn]] void fail(const std::string &path) {
    throw Failure(ExitCode::file, "cannot read " + path + ": " + std::generic_category().message(errno));
}

// size: the expected size, so that large files are not moved while they grow.
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

// Short on purpose: a target's own name may already be as long as the file system allows.
std::string temporary_name(int attempt) {
    return ".pt-" + std::to_string(getpid()) + "-" + std::to_string(attempt) + ".tmp";
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
        refuse_if(!may_follow(target, status),
                  "cannot write " + path + ": the link " + target.string() +
                      " is another user's, in a folder where everybody may write; only your own links and those of "
                      "the folder's owner are followed there",
                  ExitCode::file);
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
    constexpr mode_t permissions = 0666; // of which the system takes away what the umask says
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

void require_distinct_files(const std::vector<NamedFile> &inputs, const std::vector<NamedFile> &outputs) {
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        const auto refuse_same = [&](const NamedFile &file, bool is_input) {
            refuse_if(is_same(target_of(*output, false), target_of(file, is_input)),
                      concat(output->role, " ", output->path, ": is the same file as ", file.role, " ", file.path));
        };
        for (const NamedFile &input : inputs)
            refuse_same(input, true);
        for (auto earlier = outputs.begin(); earlier != output; ++earlier)
            refuse_same(*earlier, false);
    }
}

void require_outside(const NamedFile &folder, const std::vector<NamedFile> &outputs) {
    std::error_code ignored;
    for (const NamedFile &output : outputs) {
        const bool is_file = !output.path.empty() && output.path != standard_stream;
        refuse_if(is_file && fs::equivalent(folder_of(AtomicFile::target_of(output.path)), folder.path, ignored),
                  concat(output.role, " ", output.path, ": is in the folder of ", folder.role, " ", folder.path,
                         ", whose files are read"));
    }
}

void OutputFile::write(std::span<const std::byte> bytes) {
    if (file_)
        file_->write(bytes);
    else
        std::cout.write(reinterpret_cast<const char *>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

void OutputFile::commit() {
    if (file_) {
        file_->commit();
    } else if (!std::cout.flush()) {
        std::cout.clear(); // it is told now, and not once more at the end of the program
        throw Failure(ExitCode::file, "cannot write to standard output");
    }
}

void check_report_file(const std::string &path) {
    if (!path.empty() && path != standard_stream)
        AtomicFile::check_writable(path);
}

void write_report_file(const std::string &path, std::string_view text) {
    if (path.empty())
        return;
    OutputFile file(path);
    file.write(std::as_bytes(std::span(text)));
    file.commit();
}

void print_for_people(const std::string &lines, bool standard_output_is_taken) {
    if (standard_output_is_taken)
        print_message(lines);
    else
        std::cout << lines << std::flush;
}

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
    if (const std::size_t zero = contents.find('\0'); zero != std::string_view::npos) {
        throw Failure(ExitCode::scene,
                      path + ":" + line_and_column(contents.substr(0, zero)) + ": a NUL byte: this is not UTF-8 text");
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
