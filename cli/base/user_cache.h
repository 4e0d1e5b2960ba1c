// Where this program keeps what it can make again: below the user's folder for caches.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace cli {

using Environment = std::map<std::string, std::string>;

// Of this process.
Environment own_environment();

// The program's part of it, which need not exist. Empty if there is none: without a home directory.
std::filesystem::path user_cache(const Environment &environment);

} // namespace cli
