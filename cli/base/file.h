// Files that are read whole, or standard input. Files that appear whole or not at all: they are written under a
// temporary name beside their place, then renamed; a lock tells a temporary file in use from one that a killed program
// has left. And the rule that a command writes no file twice and none that it reads.
#pragma once

#include "lib/platform/file.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// A name that keeps other programs' files from being mistaken for ours. attempt: counts the names that were taken.
std::string temporary_name(int attempt);

// Removes temporary files in that folder that nobody has locked, because their programs were killed. Files that cannot
// be removed stay.
void remove_abandoned(const std::filesystem::path &folder);

class AtomicFile {
public:
    // Creates the temporary file. This and all functions below throw Failure(ExitCode::file) with the reason.
    explicit AtomicFile(const std::string &path);
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;
    ~AtomicFile(); // removes the temporary file unless committed

    void write(std::span<const std::byte> bytes);
    void commit();

    // Makes the checks of the constructor and leaves no file behind, not even those of programs that were killed while
    // writing to that folder.
    static void check_writable(const std::string &path);

    // The file that is written. Symbolic links are followed, whether or not their target exists yet: a rename would
    // replace the link itself. Those of other users in sticky folders where everybody may write are refused by
    // Failure(ExitCode::file), unless they belong to the folder's owner.
    static std::filesystem::path target_of(const std::string &path);

private:
    [[noreturn]] void fail(int error) const;
    void refuse_unsuitable_target() const;
    platform::FileDescriptor create_temporary();

    std::string path_; // as the user wrote it, for messages
    std::filesystem::path target_;
    std::filesystem::path temporary_;
    platform::FileDescriptor file_;
};

// A file as the user knows it: "--stats" and the path after it, or "the scene" and its path.
struct NamedFile {
    std::string role;
    std::string path; // empty: there is no such file; "-": standard input or output
};

// Throws Failure(ExitCode::usage) if two outputs, or an output and an input, are the same file, whatever path, symbolic
// or hard link leads to it.
void require_distinct_files(const std::vector<NamedFile> &inputs, const std::vector<NamedFile> &outputs);

// Throws Failure(ExitCode::usage) for an output that is, or would be, in that folder itself.
void require_outside(const NamedFile &folder, const std::vector<NamedFile> &outputs);

// Means standard input where a file is read, and standard output where one is written. A file of that name is "./-".
inline constexpr std::string_view standard_stream = "-";

class OutputFile {
public:
    // This and all functions below throw Failure(ExitCode::file) with the reason.
    explicit OutputFile(const std::string &path) {
        if (path != standard_stream)
            file_.emplace(path);
    }

    void write(std::span<const std::byte> bytes);
    void commit();

private:
    std::optional<AtomicFile> file_;
};

// An empty path means that no report is wanted.
void check_report_file(const std::string &path); // what can be checked before there is a report
void write_report_file(const std::string &path, std::string_view text);

// Lines for people: on standard output, or on stderr if a report goes to standard output.
void print_for_people(const std::string &lines, bool standard_output_is_taken);

// Both throw Failure(ExitCode::file) with the system's reason.
std::string read_file(const std::string &path);
std::string read_standard_input();

// The text of a file without the byte order mark that some editors put in front. Throws Failure(ExitCode::scene) for
// files with a NUL byte, which readers of text would take for their end, and which UTF-16 has in every second place.
std::string_view require_text(std::string_view contents, const std::string &path);

// Line and column of what follows the given part of a text, as "3:14". Both count from 1; columns are bytes.
std::string line_and_column(std::string_view before);

} // namespace cli
