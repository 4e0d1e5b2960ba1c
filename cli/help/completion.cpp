#include "cli/help/completion.h"

#include <algorithm>
#include <stdexcept>

namespace cli {

std::string completion_script(std::string_view shell, const CommandText &program) {
    if (shell == "bash") {
        return bash_completion(program);
    }
    if (shell == "zsh") {
        return zsh_completion(program);
    }
    if (shell == "fish") {
        return fish_completion(program);
    }
    throw std::out_of_range("no such shell");
}

std::string command_word(const CommandText &command) {
    return command.name.substr(command.name.find(' ') + 1);
}

std::string brief(const std::string &description) {
    std::size_t end = description.size();
    for (const char *const pause : {"; ", ": ", " ("}) {
        end = std::min(end, description.find(pause));
    }
    return description.substr(0, end);
}

} // namespace cli
