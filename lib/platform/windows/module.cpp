#include "lib/platform/module.h"

#include "lib/platform/windows/windows.h"

#include <system_error>
#include <vector>

namespace platform {

namespace fs = std::filesystem;

void *load_module(const fs::path &path) {
    constexpr DWORD beside = LOAD_LIBRARY_SEARCH_DLL_LOAD_DIR; // allowed only with absolute paths
    std::error_code error;
    const bool is_name = !path.has_parent_path();
    const fs::path file = is_name ? path : fs::absolute(path, error).make_preferred();
    return LoadLibraryExW(file.c_str(), nullptr, LOAD_LIBRARY_SEARCH_DEFAULT_DIRS | (is_name ? 0 : beside));
}

void *find_function(void *module, const char *name) {
    return reinterpret_cast<void *>(GetProcAddress(static_cast<HMODULE>(module), name));
}

std::string module_error() {
    return std::system_category().message(static_cast<int>(GetLastError()));
}

void keep_loaded(const char *) {}

fs::path folder_with(const void *function) {
    constexpr DWORD how = GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT;
    HMODULE module = nullptr;
    std::vector<wchar_t> path(32768);
    if (!GetModuleHandleExW(how, static_cast<const wchar_t *>(function), &module) ||
        GetModuleFileNameW(module, path.data(), static_cast<DWORD>(path.size())) == 0)
        return {};
    return fs::path(path.data()).parent_path();
}

std::string module_file(const std::string &name) {
    return "lib" + name + ".dll";
}

} // namespace platform
