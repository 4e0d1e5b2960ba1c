// Files that are written whole, or standard output if their name is "-".
#pragma once

#include "cli/base/atomic_file.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cli {

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
