#include "cli/base/output_file.h"

#include "cli/base/exit_code.h"
#include "cli/base/message.h"

#include <iostream>

namespace cli {

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
