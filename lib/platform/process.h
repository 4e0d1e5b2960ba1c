// This process: where it is from, what it may use, and what it runs.
#pragma once

#include <cstdint>
#include <filesystem>

namespace platform {

// A forked child has another number.
std::int64_t process_number();

std::filesystem::path program_file();

// The most memory that this process has used.
std::uint64_t peak_bytes();

// The most memory that it could ever have: RAM and swap space, within its limits, whatever others use.
std::uint64_t most_bytes();

// Drivers see it too. Not while other threads run: the environment has no lock.
void set_environment(const char *name, const char *value);

// The user's folder for what can be made again. It need not exist; empty if nothing names it.
std::filesystem::path cache_folder();

// The path of a program in the first absolute folder of PATH that has it; empty if there is none. Empty and relative
// entries are skipped, so that nothing in the current folder is run.
std::filesystem::path find_program(const std::string &name);

// Has another program take this one's place, with the arguments that follow the first two of this program's. Returns an
// exit code, or -1 and errno if it cannot be run.
int run_instead(const std::filesystem::path &program, char *const *arguments);

} // namespace platform
