// What `pt compare` tells: the figures, and which limits they exceed.
#pragma once

#include "cli/compare/compare_command.h"
#include "cli/compare/image_difference.h"
#include "cli/image/image_reader.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace cli {

struct CompareReport {
    const CompareOptions &options;
    const DecodedImage &image; // as large as the reference
    ImageDifference difference;

    // A line for each limit that is exceeded, and for pixels that are not finite where there is a limit.
    std::vector<std::string> exceeded() const;

    nlohmann::ordered_json json() const;

    // Lines for people.
    std::string text() const;
};

} // namespace cli
