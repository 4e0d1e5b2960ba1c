// Which known name a misspelt one was probably meant to be.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace cli {

// The known name that is fewest edits away; empty if none is close enough to be meant.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known);

// `unknown key "raduis", did you mean "radius"?` Without a near name, a short list of known ones is given whole.
std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string_view> known);

} // namespace cli
