#include "cli/base/other_program.h"

#include "cli/base/exit_code.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

namespace cli {
namespace {

// Empty if there is none.
std::string find_program(const std::string &file) {
    const char *variable = std::getenv("PATH");
    std::string_view rest = variable == nullptr ? "" : variable;
    while (!rest.empty()) {
        const std::size_t length = std::min(rest.find(':'), rest.size());
        const std::filesystem::path folder(rest.substr(0, length));
        rest.remove_prefix(std::min(length + 1, rest.size()));
        const std::filesystem::path path = folder / file;
        std::error_code ignored;
        if (folder.is_absolute() && std::filesystem::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0)
            return path;
    }
    return {};
}

} // namespace

bool may_name_program(std::string_view name) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    return !name.empty() && name.front() != '-' && name.find_first_not_of(letters) == std::string_view::npos;
}

void run_other_program(std::string_view name, char *const *arguments) {
    std::string program = find_program("pt-" + std::string(name));
    if (program.empty())
        return;
    std::vector<char *> passed{program.data()};
    do
        passed.push_back(*++arguments);
    while (passed.back() != nullptr);
    execv(program.c_str(), passed.data());
    throw Failure(ExitCode::file, program + ": cannot be run: " + std::strerror(errno));
}

std::string_view installation_of(std::string_view name) {
    if (name == "figure")
        return "comes with the Python package: pip install './lib/python[figure]'";
    if (name == "tachyon")
        return "comes with the Python package: pip install ./lib/python";
    if (name == "farm")
        return "comes with the Python package: pip install './lib/python[farm]'";
    return {};
}

} // namespace cli
