#include "cli/course/course_files.h"

#include "cli/base/exit_code.h"
#include "cli/base/file.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace cli {

std::string course_file(const std::string &path) {
    return std::string(std::ranges::find(course_files(), path, &CourseFile::path)->text);
}

void write_course(const std::string &folder) {
    namespace fs = std::filesystem;
    std::error_code error;
    const bool exists = fs::exists(folder, error);
    refuse_if(exists && !fs::is_directory(folder, error), folder + ": must be a folder", ExitCode::file);
    refuse_if(exists && !fs::is_empty(folder, error), folder + ": must be empty", ExitCode::file);
    for (const CourseFile &file : course_files()) {
        const fs::path path = fs::path(folder) / file.path;
        fs::create_directories(path.parent_path(), error);
        refuse_if(static_cast<bool>(error), folder + ": cannot be created: " + error.message(), ExitCode::file);
        write_report_file(path.string(), file.text);
    }
}

} // namespace cli
