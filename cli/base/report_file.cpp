#include "cli/base/report_file.h"

#include "cli/base/atomic_file.h"
#include "cli/base/exit_code.h"
#include "cli/base/message.h"

#include <iostream>

namespace cli {

void check_report_file(const std::string &path) {
    if (!path.empty() && path != standard_stream)
        AtomicFile::check_writable(path);
}

void write_report_file(const std::string &path, std::string_view text) {
    if (path.empty())
        return;
    if (path != standard_stream)
        AtomicFile::write_text(path, text);
    else if (!(std::cout << text << std::flush))
        throw Failure(ExitCode::file, "cannot write to standard output");
}

void print_for_people(const std::string &lines, bool standard_output_is_taken) {
    if (standard_output_is_taken)
        print_message(lines);
    else
        std::cout << lines << std::flush;
}

} // namespace cli
