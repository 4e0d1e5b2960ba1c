#pragma once

#include <cstdint>
#include <string>

namespace cli {

// Building four kernels takes about as long as this many samples.
inline constexpr std::uint64_t trial_pays_from = std::uint64_t{1} << 24;

// Returns the least CPU seconds of several runs, because other processes only add time. Infinite on failure.
double trial_seconds(unsigned int bits, const std::string &device, bool has_tree);

} // namespace cli
