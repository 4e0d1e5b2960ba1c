// This process: its files, its memory, and programs that it runs.
#pragma once

#include <cstdint>
#include <filesystem>

namespace platform {

// A forked child has another number.
std::int64_t process_number();

std::filesystem::path program_file();

// The most memory used so far.
std::uint64_t peak_bytes();

// The most memory that it could ever have: RAM and swap, within its limits.
std::uint64_t most_bytes();

// Visible to drivers. Not thread-safe: the environment has no lock.
void set_environment(const char *name, const char *value);

// The user's cache folder, which need not exist; empty if unknown.
std::filesystem::path cache_folder();

// The program's path in the first absolute folder of PATH that has it, or empty. Skips empty and relative entries, so
// that nothing in the current folder is run.
std::filesystem::path find_program(const std::string &name);

// Replaces this process by another program, with the arguments after the first two. Returns an exit code, or -1 and
// errno if it cannot be run.
int run_instead(const std::filesystem::path &program, char *const *arguments);

} // namespace platform
