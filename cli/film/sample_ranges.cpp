#include "cli/film/sample_ranges.h"

#include <algorithm>

namespace cli {

std::string ranges_text(const std::vector<pt_sample_range> &ranges) {
    std::string text;
    for (const pt_sample_range &range : ranges)
        text += (text.empty() ? "[" : ", [") + std::to_string(range.first) + ", " + std::to_string(range.end) + ")";
    return text.empty() ? "none" : text;
}

std::uint64_t sample_count_of(const std::vector<pt_sample_range> &ranges) {
    std::uint64_t count = 0;
    for (const pt_sample_range &range : ranges)
        count += range.end - range.first;
    return count;
}

std::vector<pt_sample_range> missing_of(const pt_sample_range &wanted, const std::vector<pt_sample_range> &there) {
    std::vector<pt_sample_range> missing;
    std::uint64_t next = wanted.first;
    for (const pt_sample_range &range : there) {
        if (next < std::min(range.first, wanted.end))
            missing.push_back({next, std::min(range.first, wanted.end)});
        next = std::max(next, range.end);
    }
    if (next < wanted.end)
        missing.push_back({next, wanted.end});
    return missing;
}

} // namespace cli
