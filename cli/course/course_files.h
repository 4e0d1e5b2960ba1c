// Files that the program contains: the kernel that students start with, its includes, and the course's scenes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cli {

struct CourseFile {
    std::string_view path; // in the student's folder
    std::string_view text;
};

const std::vector<CourseFile> &course_files();

std::string course_file(const std::string &path);

// Throws Failure if the folder is not empty or cannot be written.
void write_course(const std::string &folder);

} // namespace cli
