// The functions of the image module (image_module.h), which is loaded when the first of them is needed.
#pragma once

#include <filesystem>

namespace cli {

// Where the module is, seen from the program. Throws Failure(ExitCode::file) if it is not there: it is a package of its
// own, and not built everywhere.
std::filesystem::path module_path();

// name: PT_ENCODE_IMAGE_SYMBOL or another of that header. Throws Failure(ExitCode::internal) if it cannot be loaded.
void *load_symbol(const std::filesystem::path &path, const char *name);

} // namespace cli
