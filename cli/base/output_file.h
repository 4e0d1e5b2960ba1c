// Files that are written whole, or standard output if their name is "-"; and the rule that a command writes no file
// twice and none that it reads, checked before there is anything to lose.
#pragma once

#include "cli/base/atomic_file.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

// As the user knows it: "--stats" and the path after it, or "the scene" and its path.
struct NamedFile {
    std::string role;
    std::string path; // empty: there is no such file; "-": standard input or output
};

// Throws Failure(ExitCode::usage) if two outputs, or an output and an input, are one file: by whatever path, symbolic
// or hard link.
void require_distinct_files(const std::vector<NamedFile> &inputs, const std::vector<NamedFile> &outputs);

// Throws Failure(ExitCode::usage) for an output that is, or would be, in that folder itself.
void require_outside(const NamedFile &folder, const std::vector<NamedFile> &outputs);

// Standard input where a file is read, standard output where one is written. A file of that name is "./-".
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

// The path of a report may be empty: none is wanted.
void check_report_file(const std::string &path); // what can be checked before there is a report
void write_report_file(const std::string &path, std::string_view text);

// Lines for people: on standard output, or on stderr if a report goes to standard output.
void print_for_people(const std::string &lines, bool standard_output_is_taken);

} // namespace cli
