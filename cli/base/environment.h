#pragma once

#include <filesystem>

namespace cli {

// Empty without a home directory. The folder may not exist.
std::filesystem::path user_cache();

} // namespace cli
