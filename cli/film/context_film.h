// The film of a context, as bytes and from a file.
#pragma once

#include "cli/base/context.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace cli {

// The samples so far, of which there is one at least; bytes: memory to be used again.
void save_film(const Context &context, std::vector<std::byte> &bytes);

std::vector<std::byte> saved_film(const Context &context);

// Adds a film to the samples of the context. path: what it is called in messages. Throws Failure(ExitCode::usage) with
// a line for each way in which it does not belong.
void add_film(const Context &context, const std::string &path, std::span<const std::byte> bytes);

} // namespace cli
