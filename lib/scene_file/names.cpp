#include "lib/scene_file/names.h"

#include "lib/platform/printable.h"
#include "lib/scene_file/text.h"

#include <cctype>
#include <vector>

namespace pt {
namespace {

char lower(char letter) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
}

// Optimal string alignment distance, ignoring case. 80% of misspellings are one edit (Damerau 1964).
std::size_t edit_distance(std::string_view from, std::string_view to) {
    std::vector<std::size_t> before_last(to.size() + 1);
    std::vector<std::size_t> last(to.size() + 1);
    std::vector<std::size_t> row(to.size() + 1);
    for (std::size_t column = 0; column <= to.size(); ++column)
        row[column] = column;
    for (std::size_t i = 1; i <= from.size(); ++i) {
        std::swap(before_last, last);
        std::swap(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= to.size(); ++j) {
            const bool same = lower(from[i - 1]) == lower(to[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
            if (i > 1 && j > 1 && lower(from[i - 1]) == lower(to[j - 2]) && lower(from[i - 2]) == lower(to[j - 1]))
                row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row[to.size()];
}

} // namespace

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known) {
    std::size_t best_distance = std::max<std::size_t>(1, name.size() / 3) + 1;
    std::string_view best;
    for (const std::string_view candidate : known) {
        const std::size_t shorter = std::min(candidate.size(), name.size());
        const std::size_t longer = std::max(candidate.size(), name.size());
        if (longer - shorter >= best_distance)
            continue;
        const std::size_t distance = edit_distance(name, candidate);
        if (distance < best_distance) {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

std::string unknown_name(std::string_view kind, std::string_view name, std::span<const std::string_view> known) {
    constexpr std::size_t longest_list = 12;
    std::string message = concat("unknown ", kind, " \"", name, "\"");
    const std::string_view nearest = nearest_name(name, known);
    if (!nearest.empty())
        message += concat(", did you mean \"", nearest, "\"?");
    else if (!known.empty() && known.size() <= longest_list)
        message += ", known: " + listed(known);
    return platform::printable(message);
}

} // namespace pt
