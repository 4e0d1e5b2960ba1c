// This process: its files, its memory, and programs that it runs.
#pragma once

#include <cstdint>
#include <filesystem>

namespace platform {

std::int64_t process_number();

std::filesystem::path program_file();

std::uint64_t peak_bytes();

// RAM and swap, within this process's limits.
std::uint64_t most_bytes();

// Drivers see the variable, too. Not thread-safe, because the environment has no lock.
void set_environment(const char *name, const char *value);

// The folder may not exist. Empty if unknown.
std::filesystem::path cache_folder();

// Looks in the absolute folders of PATH, so that no file of the current folder is run. Empty if not found.
std::filesystem::path find_program(const std::string &name);

// Replaces this process by another program, with the arguments after the first two. Returns -1 and errno if the program
// cannot be run, or its exit code where a process cannot be replaced.
int run_instead(const std::filesystem::path &program, char *const *arguments);

} // namespace platform
