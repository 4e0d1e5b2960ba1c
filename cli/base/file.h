// Reads files whole, and writes them whole or not at all: to a temporary name beside their place, then renamed. A lock
// marks temporary files in use; killed programs leave others.
#pragma once

#include "cli/base/exit_code.h"
#include "lib/platform/file.h"
#include "lib/platform/input_file.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// attempt: counts taken names.
std::string temporary_name(int attempt);

// Removes unlocked temporary files, left by killed programs, where permitted.
void remove_abandoned(const std::filesystem::path &folder);

class AtomicFile {
public:
    // Creates the temporary file. All functions throw Failure(ExitCode::file) with the reason.
    explicit AtomicFile(const std::string &path);
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;
    ~AtomicFile(); // removes the temporary file unless committed

    void write(std::span<const std::byte> bytes);
    void commit();

    // The constructor's checks, without leaving a file; also removes abandoned ones.
    static void check_writable(const std::string &path);

    // The file that is written, behind symbolic links, because a rename would replace the link. Throws
    // Failure(ExitCode::file) for another user's link in a sticky folder that everybody may write, except the folder
    // owner's.
    static std::filesystem::path target_of(const std::string &path);

private:
    [[noreturn]] void fail(int error) const;
    void refuse_unsuitable_target() const;
    platform::FileDescriptor create_temporary();

    std::string path_; // as the user wrote it
    std::filesystem::path target_;
    std::filesystem::path temporary_;
    platform::FileDescriptor file_;
};

// "--stats" or "the scene", with its path.
struct NamedFile {
    std::string role;
    std::string path; // empty: none; "-": standard input or output
};

// Throws Failure(ExitCode::usage) if outputs, or an output and an input, are one file by any path or link.
void require_distinct_files(const std::vector<NamedFile> &inputs, const std::vector<NamedFile> &outputs);

// Throws Failure(ExitCode::usage) for an output directly in that folder, existing or not.
void require_outside(const NamedFile &folder, const std::vector<NamedFile> &outputs);

// A file of that name is "./-".
inline constexpr std::string_view standard_stream = "-";

class OutputFile {
public:
    // All functions throw Failure(ExitCode::file) with the reason.
    explicit OutputFile(const std::string &path) {
        if (path != standard_stream)
            file_.emplace(path);
    }

    void write(std::span<const std::byte> bytes);
    void commit();

private:
    std::optional<AtomicFile> file_;
};

// An empty path means no report.
void check_report_file(const std::string &path); // what can be checked beforehand
void write_report_file(const std::string &path, std::string_view text);

// To stderr if a report takes standard output.
void print_for_people(const std::string &lines, bool standard_output_is_taken);

// "cannot read PATH: " and the reason, with ExitCode::file.
Failure unreadable(const std::string &path, const platform::InputError &error);

// Returns what `read` makes of the file. Throws unreadable().
template <typename Read>
auto read_file(const std::string &path, Read read) {
    try {
        platform::InputFile file(path);
        return read(file);
    } catch (const platform::InputError &error) {
        throw unreadable(path, error);
    }
}

// Reads a file or standard input, up to a NUL byte at least. Throws unreadable().
std::string read_text(const std::string &path);

// Removes a byte order mark. Throws Failure(ExitCode::scene) at a NUL byte, which readers would take for the end.
std::string_view require_text(std::string_view contents, const std::string &path);

// "3:14": the place after this text, from 1; columns are bytes.
std::string line_and_column(std::string_view before);

} // namespace cli
