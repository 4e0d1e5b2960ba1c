// The rule that a command writes no file twice and none that it reads, checked before there is anything to lose.
#pragma once

#include <string>
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

} // namespace cli
