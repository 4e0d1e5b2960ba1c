#include "lib/platform/process.h"

#include <cstdlib>
#include <sstream>
#include <string>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace platform {

namespace fs = std::filesystem;

std::int64_t process_number() {
    return getpid();
}

void set_environment(const char *name, const char *value) {
    setenv(name, value, 1);
}

// Ignores relative paths, as the XDG Base Directory Specification requires.
fs::path cache_folder() {
    const auto folder = [](const char *name) {
        const char *variable = std::getenv(name);
        fs::path path = variable == nullptr ? "" : variable;
        return path.is_absolute() ? path : fs::path();
    };
    if (fs::path path = folder("XDG_CACHE_HOME"); !path.empty())
        return path;
    const fs::path home = folder("HOME");
    return home.empty() ? home : home / ".cache";
}

fs::path find_program(const std::string &name) {
    const char *variable = std::getenv("PATH");
    std::istringstream folders(variable == nullptr ? "" : variable);
    for (std::string folder; std::getline(folders, folder, ':');) {
        fs::path path = fs::path(folder) / name;
        std::error_code ignored;
        if (path.is_absolute() && fs::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0)
            return path;
    }
    return {};
}

int run_instead(const fs::path &program, char *const *arguments) {
    std::string name = program;
    std::vector<char *> passed{name.data()};
    for (arguments += 2; *arguments != nullptr; ++arguments)
        passed.push_back(*arguments);
    passed.push_back(nullptr);
    return execv(program.c_str(), passed.data());
}

} // namespace platform
