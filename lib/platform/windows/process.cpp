#include "lib/platform/process.h"

#include "lib/platform/windows/windows.h"

#include <cerrno>
#include <cstdlib>
#include <psapi.h>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace platform {
namespace {

namespace fs = std::filesystem;

// Skips a word. Supports quotes only around whole words.
const wchar_t *after_word(const wchar_t *line) {
    const wchar_t end = *line == L'"' ? L'"' : L' ';
    line += *line == L'"' ? 1 : 0;
    while (*line != L'\0' && *line != end)
        ++line;
    line += *line == L'"' ? 1 : 0;
    while (*line == L' ')
        ++line;
    return line;
}

} // namespace

std::int64_t process_number() {
    return GetCurrentProcessId();
}

fs::path program_file() {
    std::vector<wchar_t> path(32768);
    GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size()));
    return path.data();
}

std::uint64_t peak_bytes() {
    PROCESS_MEMORY_COUNTERS counters{};
    K32GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters);
    return counters.PeakWorkingSetSize;
}

std::uint64_t most_bytes() {
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    GlobalMemoryStatusEx(&status);
    return status.ullTotalPageFile;
}

void set_environment(const char *name, const char *value) {
    _putenv_s(name, value);
}

fs::path cache_folder() {
    const char *variable = std::getenv("LOCALAPPDATA");
    const fs::path path = variable == nullptr ? "" : variable;
    return path.is_absolute() ? path : fs::path();
}

fs::path find_program(const std::string &name) {
    const char *variable = std::getenv("PATH");
    std::istringstream folders(variable == nullptr ? "" : variable);
    for (std::string folder; std::getline(folders, folder, ';');) {
        const fs::path path = fs::path(folder) / (name + ".exe");
        std::error_code ignored;
        if (path.is_absolute() && fs::is_regular_file(path, ignored))
            return path;
    }
    return {};
}

int run_instead(const fs::path &program, char *const *) {
    std::wstring line = L'"' + program.wstring() + L"\" " + after_word(after_word(GetCommandLineW()));
    STARTUPINFOW start{};
    start.cb = sizeof start;
    PROCESS_INFORMATION process{};
    if (!CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr, &start, &process)) {
        errno = ENOEXEC;
        return -1;
    }
    DWORD code = 0;
    WaitForSingleObject(process.hProcess, INFINITE);
    GetExitCodeProcess(process.hProcess, &code);
    CloseHandle(process.hThread);
    CloseHandle(process.hProcess);
    return static_cast<int>(code & 0x7FFFFFFF);
}

} // namespace platform
