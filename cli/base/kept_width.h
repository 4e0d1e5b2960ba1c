#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace cli {

struct KeptWidth {
    unsigned int bits;
    std::string driver;
};

// Returns nothing if the file is damaged or from another processor.
std::optional<KeptWidth> read_width(const std::filesystem::path &file);
void write_width(const std::filesystem::path &file, const KeptWidth &width);

} // namespace cli
