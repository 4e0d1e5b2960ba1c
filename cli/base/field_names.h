// Owns what fields of pt.h are called where users give them: options of the command line and keys of the scene file. A
// message of the library begins each line with the field that it speaks of: "render.width = 0: must be >= 1".
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace cli {

struct FieldName {
    std::string_view field;
    std::string_view option; // empty: no option gives it
    std::string_view key;    // empty: the scene file does not have it
};

// Those that are called differently, and all that options give.
inline constexpr std::array<FieldName, 7> field_names{{
    {"camera.target", "", "camera.look_at"},
    {"camera.shutter_open", "", "camera.shutter[0]"},
    {"camera.shutter_close", "", "camera.shutter[1]"},
    {"render.width", "--size: width", "film.width"},
    {"render.height", "--size: height", "film.height"},
    {"render.max_path_length", "--max-path-length", "render.max_path_length"},
    {"create.submit_milliseconds", "--submit-ms", ""},
}};

// That of the line's field, "camera.target" where it begins with "camera.target[0]"; nullptr if it has none.
const FieldName *find_field_name(std::string_view line);

// The line with the option in the field's place: "--size: width = 0: must be >= 1". As it is where no option gives it.
std::string in_words_of_options(std::string_view line);

} // namespace cli
