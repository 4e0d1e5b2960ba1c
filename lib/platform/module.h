// Loads libraries at run time. They stay loaded.
#pragma once

#include <filesystem>
#include <string>

namespace platform {

// Loads a path, or a name from the system's folders. Returns NULL on failure; module_error() has the reason.
void *load_module(const std::filesystem::path &path);
void *find_function(void *module, const char *name);
std::string module_error();

void keep_loaded(const char *name);

std::filesystem::path folder_with(const void *function);

std::string module_file(const std::string &name);
extern const char *const denoiser_file;

} // namespace platform
