// The lock that tells a temporary file in use from one that a killed program has left, and the removal of the latter.
#pragma once

#include <filesystem>
#include <string>

namespace cli {

// A name in which nobody else's files are mistaken for ours; attempt: counts the names that are taken already.
std::string temporary_name(int attempt);

// Locks a temporary file that was just created. False if it was removed in between, as an abandoned one. On a file
// system without locks it is true, and nothing is ever removed there.
bool lock_temporary(int descriptor);

// Removes temporary files of that folder which nobody has locked: their programs were killed. What cannot be removed
// stays.
void remove_abandoned(const std::filesystem::path &folder);

} // namespace cli
