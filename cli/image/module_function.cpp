#include "cli/image/module_function.h"

#include "cli/base/exit_code.h"

#include <dlfcn.h>
#include <string>
#include <unistd.h>

namespace cli {

// PT_MODULE_DIRECTORY is relative to the program, so that an installed tree can be moved.
std::filesystem::path module_path() {
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
    std::filesystem::path path = program.parent_path() / PT_MODULE_DIRECTORY / "libpt-image-file.so";
    path = path.lexically_normal();
    if (access(path.c_str(), R_OK) != 0) {
        throw Failure(ExitCode::file, "EXR and JPEG need the image module, and there is no " + path.string() +
                                          ": install the package pt-image-formats, or libopenimageio-dev before "
                                          "building pt; PNG needs neither");
    }
    return path;
}

// Never unloaded: OpenImageIO keeps threads and static objects.
void *load_symbol(const std::filesystem::path &path, const char *name) {
    void *module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void *symbol = module == nullptr ? nullptr : dlsym(module, name);
    if (symbol == nullptr)
        throw Failure(ExitCode::internal, std::string("cannot load the image module: ") + dlerror());
    return symbol;
}

} // namespace cli
