// Ends the process if a condition does not hold. Used by all targets.
#pragma once

#include <string_view>

namespace fuzz {

// Prints what and aborts, unless it holds.
void require(bool holds, std::string_view what);

} // namespace fuzz
