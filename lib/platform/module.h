// Libraries loaded at run time, which stay loaded.
#pragma once

#include <filesystem>
#include <string>

namespace platform {

// path: or a name, looked for in the system's folders, never in the working directory. NULL on failure, with the reason
// in module_error().
void *load_module(const std::filesystem::path &path);
void *find_function(void *module, const char *name);
std::string module_error();

void keep_loaded(const char *name);

// The folder of the library or program with the function; empty if unknown.
std::filesystem::path folder_with(const void *function);

// File names of a module of this project, and of Open Image Denoise 2.
std::string module_file(const std::string &name);
extern const char *const denoiser_file;

} // namespace platform
