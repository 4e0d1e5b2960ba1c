// What the library says of a film, in words about the file that it came from.
#pragma once

#include "cli/base/library_error.h"

#include <string>

namespace cli {

// "part.ptfilm: seed = 7: must be 8, as in this context", a line for each difference.
std::string film_words(const std::string &path, const LibraryError &error);

} // namespace cli
