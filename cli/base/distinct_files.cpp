#include "cli/base/distinct_files.h"

#include "cli/base/atomic_file.h"
#include "cli/base/exit_code.h"
#include "cli/base/output_file.h"

#include <compare>
#include <filesystem>
#include <map>
#include <optional>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace cli {
namespace {

// A file that exists is identified by its device and inode, and name is empty; one that does not, by those of its
// folder and its name there.
struct Identity {
    dev_t device;
    ino_t inode;
    std::string name;

    // clang-tidy 14 takes what compares the result with 0 for a pointer.
    auto operator<=>(const Identity &) const = default; // NOLINT(modernize-use-nullptr)
};

Identity identity_of(const struct stat &status, const std::string &name = "") {
    return {status.st_dev, status.st_ino, name};
}

std::filesystem::path folder_of(const std::filesystem::path &path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

// Nothing for an empty path, or if there is not even a folder.
std::optional<Identity> identity_of(const std::string &path) {
    struct stat status {};
    if (path.empty())
        return std::nullopt;
    if (stat(path.c_str(), &status) == 0)
        return identity_of(status);
    const std::filesystem::path target = AtomicFile::target_of(path);
    if (stat(folder_of(target).c_str(), &status) == 0)
        return identity_of(status, target.filename());
    return std::nullopt;
}

// "-" is whatever standard output leads to: two reports on one stream would be mixed up.
std::optional<Identity> identity_of_output(const std::string &path) {
    struct stat status {};
    if (path == standard_stream)
        return fstat(STDOUT_FILENO, &status) == 0 ? std::optional(identity_of(status)) : std::nullopt;
    return identity_of(path);
}

// "-" is what standard input leads to, if that is a file: a terminal may be read and written at the same time.
std::optional<Identity> identity_of_input(const std::string &path) {
    struct stat status {};
    if (path == standard_stream) {
        const bool is_file = fstat(STDIN_FILENO, &status) == 0 && S_ISREG(status.st_mode);
        return is_file ? std::optional(identity_of(status)) : std::nullopt;
    }
    return identity_of(path);
}

std::string text_of(const NamedFile &file) {
    return file.role + " " + file.path;
}

} // namespace

void require_distinct_files(const std::vector<NamedFile> &inputs, const std::vector<NamedFile> &outputs) {
    std::map<Identity, const NamedFile *> known;
    for (const NamedFile &input : inputs)
        if (const auto identity = identity_of_input(input.path))
            known.emplace(*identity, &input);
    for (const NamedFile &output : outputs) {
        const auto identity = identity_of_output(output.path);
        if (identity && !known.emplace(*identity, &output).second)
            throw Failure(ExitCode::usage, text_of(output) + ": is the same file as " + text_of(*known.at(*identity)));
    }
}

void require_outside(const NamedFile &folder, const std::vector<NamedFile> &outputs) {
    std::error_code ignored;
    for (const NamedFile &output : outputs) {
        const bool is_file = !output.path.empty() && output.path != standard_stream;
        if (is_file &&
            std::filesystem::equivalent(folder_of(AtomicFile::target_of(output.path)), folder.path, ignored)) {
            throw Failure(ExitCode::usage,
                          text_of(output) + ": is in the folder of " + text_of(folder) + ", whose files are read");
        }
    }
}

} // namespace cli
