// Owns what fields of pt.h are called where users give them: options of the command line and keys of the scene file.
#pragma once

#include "cli/base/library_error.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cli {

struct FieldName {
    std::string_view subject; // as in pt_broken_rule, like the member
    std::string_view member;
    std::string_view option;  // empty: no option gives it
    std::string_view section; // empty: the scene file does not have it
    std::string_view key;
    std::optional<std::size_t> element = std::nullopt; // of the key's array
};

// Those that are called differently, and all that options give.
inline constexpr std::array<FieldName, 12> field_names{{
    {"camera", "target", "", "camera", "look_at"},
    {"camera", "shutter_open", "", "camera", "shutter", 0},
    {"camera", "shutter_close", "", "camera", "shutter", 1},
    {"render", "width", "--size: width", "film", "width"},
    {"render", "height", "--size: height", "film", "height"},
    {"render", "max_path_length", "--max-path-length", "render", "max_path_length"},
    {"accumulate", "sample_count", "--spp", "render", "spp"},
    {"accumulate", "target_error", "--error", "", ""},
    {"accumulate", "sampling", "--sampling", "", ""},
    {"create", "device", "--device", "", ""},
    {"create", "shader_dir", "--shader-dir", "", ""},
    {"create", "submit_milliseconds", "--submit-ms", "", ""},
}};

// That of the rule's field; nullptr if it has none.
const FieldName *find_field_name(const BrokenRule &rule);

// With the option in the field's place: "--size: width = 0: must be >= 1". The library's name where no option gives it.
std::string in_words_of_options(const BrokenRule &rule);
std::string in_words_of_options(const LibraryError &error);

} // namespace cli
