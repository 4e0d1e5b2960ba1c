#include "cli/base/user_cache.h"

#include <unistd.h>

namespace cli {

Environment own_environment() {
    Environment environment;
    for (char **entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
        const std::string text = *entry;
        const std::size_t end = text.find('=');
        environment.emplace(text.substr(0, end), end == std::string::npos ? "" : text.substr(end + 1));
    }
    return environment;
}

// By the XDG Base Directory Specification, which ignores relative paths.
std::filesystem::path user_cache(const Environment &environment) {
    const auto folder = [&](const char *name) {
        const auto found = environment.find(name);
        const std::filesystem::path path = found == environment.end() ? "" : found->second;
        return path.is_absolute() ? path : std::filesystem::path();
    };
    if (const std::filesystem::path path = folder("XDG_CACHE_HOME"); !path.empty())
        return path / "pt";
    const std::filesystem::path home = folder("HOME");
    return home.empty() ? home : home / ".cache" / "pt";
}

} // namespace cli
