// Ranges of sample indices as the command line shows them: what there is, and what is missing.
#pragma once

#include <pt/film.h>

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

// "[0, 64), [128, 256)"; "none" of none.
std::string ranges_text(const std::vector<pt_sample_range> &ranges);

// How many samples they have.
std::uint64_t sample_count_of(const std::vector<pt_sample_range> &ranges);

// What a range has and the others, which are in ascending order, have not.
std::vector<pt_sample_range> missing_of(const pt_sample_range &wanted, const std::vector<pt_sample_range> &there);

} // namespace cli
