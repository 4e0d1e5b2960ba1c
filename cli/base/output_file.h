// A file that is written whole, or standard output if its name is "-".
#pragma once

#include "cli/base/atomic_file.h"
#include "cli/base/exit_code.h"
#include "cli/base/report_file.h"

#include <cstddef>
#include <iostream>
#include <optional>
#include <span>
#include <string>

namespace cli {

class OutputFile {
public:
    // This and all functions below throw Failure(ExitCode::file) with the reason.
    explicit OutputFile(const std::string &path) {
        if (path != standard_stream)
            file_.emplace(path);
    }

    void write(std::span<const std::byte> bytes) {
        if (file_)
            file_->write(bytes);
        else
            std::cout.write(reinterpret_cast<const char *>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }

    void commit() {
        if (file_) {
            file_->commit();
        } else if (!std::cout.flush()) {
            std::cout.clear(); // it is told now, and not once more at the end of the program
            throw Failure(ExitCode::file, "cannot write to standard output");
        }
    }

private:
    std::optional<AtomicFile> file_;
};

} // namespace cli
