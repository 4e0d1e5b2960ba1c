// Libraries that are loaded while a program runs, and stay loaded.
#pragma once

#include <filesystem>
#include <string>

namespace platform {

// A path, or the name of a library that is looked for where the system has its own, never in the working directory.
// NULL if it cannot be loaded, or the function not found; module_error() then says why.
void *load_module(const std::filesystem::path &path);
void *find_function(void *module, const char *name);
std::string module_error();

// Keeps a library loaded if it is.
void keep_loaded(const char *name);

// The folder of the library or program that contains this function. Empty if that is not known.
std::filesystem::path folder_with(const void *function);

// The names of files: of a module of this project, and of Open Image Denoise 2.
std::string module_file(const std::string &name);
extern const char *const denoiser_file;

} // namespace platform
