#pragma once

#include <cstdint>
#include <filesystem>

namespace platform {

std::int64_t process_number();

std::filesystem::path program_file();

std::uint64_t peak_bytes();

// Returns the size of RAM and swap, or the process's limit if that is less.
std::uint64_t most_bytes();

// Not thread-safe.
void set_environment(const char *name, const char *value);

// The folder may not exist. The path is empty if unknown.
std::filesystem::path cache_folder();

// Searches only absolute folders of PATH, so that no file of the current folder is run. Returns an empty path if no
// folder has the program.
std::filesystem::path find_program(const std::string &name);

// Replaces this process by another program, which gets the arguments after the first two. Returns -1 and sets errno if
// the program cannot be run. On Windows, waits for the program and returns its exit code.
int run_instead(const std::filesystem::path &program, char *const *arguments);

} // namespace platform
