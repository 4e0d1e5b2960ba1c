#include "lib/platform/module.h"

#include <dlfcn.h>
#include <system_error>

namespace platform {

void *load_module(const std::filesystem::path &path) {
    return dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
}

void *find_function(void *module, const char *name) {
    return dlsym(module, name);
}

std::string module_error() {
    return dlerror();
}

void keep_loaded(const char *name) {
    if (void *const loaded = dlopen(name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE))
        dlclose(loaded); // releases only the reference of this dlopen
}

// dladdr may give a relative path. It is used only if it still names the loaded file.
std::filesystem::path folder_with(const void *function) {
    Dl_info info{};
    if (dladdr(function, &info) == 0 || !info.dli_fname)
        return {};
    std::error_code error;
    const std::filesystem::path path = std::filesystem::absolute(info.dli_fname, error);
    if (error)
        return {};
    if (info.dli_fname[0] != '/') {
        void *const loaded = dlopen(path.c_str(), RTLD_LAZY | RTLD_NOLOAD);
        if (!loaded)
            return {};
        dlclose(loaded);
    }
    return path.parent_path();
}

std::string module_file(const std::string &name) {
    return "lib" + name + ".so"; // CMake's modules have this ending on macOS too
}

} // namespace platform
