// Scripts by which shells complete command lines of the program.
#pragma once

#include "cli/help/command_text.h"

#include <array>
#include <string>
#include <string_view>

namespace cli {

inline constexpr std::array<std::string_view, 3> shells{"bash", "zsh", "fish"};

// Throws std::out_of_range for another shell.
std::string completion_script(std::string_view shell, const CommandText &program);

std::string bash_completion(const CommandText &program);
std::string zsh_completion(const CommandText &program);
std::string fish_completion(const CommandText &program);

// The name that a command is called by: "render".
std::string command_word(const CommandText &command);

// The beginning of a description, as long as a shell's list has room for it.
std::string brief(const std::string &description);

// Parted by blanks.
template <typename Texts>
std::string in_one_line(const Texts &texts) {
    std::string line;
    for (const auto &text : texts) {
        line.append(line.empty() ? "" : " ").append(text);
    }
    return line;
}

} // namespace cli
