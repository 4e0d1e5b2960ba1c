#include "cli/base/output_file.h"

#include "cli/base/exit_code.h"
#include "cli/base/message.h"

#include <filesystem>
#include <iostream>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace cli {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path &path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

// What the path leads to; empty if there is no such file. A terminal may be read and written at the same time.
fs::path target_of(const NamedFile &file, bool is_input) {
    struct stat status {};
    if (file.path != standard_stream)
        return file.path;
    if (is_input)
        return fstat(STDIN_FILENO, &status) == 0 && S_ISREG(status.st_mode) ? "/dev/stdin" : "";
    return "/dev/stdout"; // whatever it leads to: two reports on one stream would be mixed up
}

// Whether they are one file, or would be: then their folders are one, and their names there.
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

} // namespace

void require_distinct_files(const std::vector<NamedFile> &inputs, const std::vector<NamedFile> &outputs) {
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        const auto refuse_same = [&](const NamedFile &file, bool is_input) {
            if (is_same(target_of(*output, false), target_of(file, is_input))) {
                throw Failure(ExitCode::usage, output->role + " " + output->path + ": is the same file as " +
                                                   file.role + " " + file.path);
            }
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
        if (is_file && fs::equivalent(folder_of(AtomicFile::target_of(output.path)), folder.path, ignored)) {
            throw Failure(ExitCode::usage, output.role + " " + output.path + ": is in the folder of " + folder.role +
                                               " " + folder.path + ", whose files are read");
        }
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

} // namespace cli
