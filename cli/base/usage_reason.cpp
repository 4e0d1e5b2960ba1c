#include "cli/base/usage_reason.h"

#include "cli/base/unknown_argument.h"

#include <CLI/CLI.hpp>

#include <string_view>
#include <vector>

namespace cli {
namespace {

// CLI11 says "--spp: At Most 1 required but received 2" and "--spp: 1 required N missing".
std::string reason_of_count(const std::string &text) {
    constexpr std::string_view received = " but received ";
    constexpr std::string_view required = " required ";
    constexpr std::string_view missing = " missing";
    const std::string name = text.substr(0, text.find(':'));
    if (const std::size_t at = text.rfind(received); at != std::string::npos)
        return name + ": is given " + text.substr(at + received.size()) + " times, and takes one value";
    const std::size_t at = text.find(required);
    if (at != std::string::npos && text.ends_with(missing)) {
        const std::size_t begin = at + required.size();
        return name + ": its value is missing: " + text.substr(begin, text.size() - missing.size() - begin);
    }
    return text;
}

std::string reason_of(const CLI::App &command, const CLI::ParseError &error) {
    const bool is_count = dynamic_cast<const CLI::ArgumentMismatch *>(&error) != nullptr;
    return unknown_argument(command).value_or(is_count ? reason_of_count(error.what()) : error.what());
}

} // namespace

std::string usage_reason(const CLI::App &program, const CLI::ParseError &error) {
    const std::vector<CLI::App *> parsed = program.get_subcommands();
    if (parsed.empty())
        return reason_of(program, error) + " (see pt --help)";
    const CLI::App &command = *parsed.front();
    const std::string see = " (see pt " + command.get_name() + " --help)";
    const std::vector<std::string> before = program.remaining();
    if (!before.empty())
        return before.front() + ": stands before the command; its options stand after it" + see;
    return reason_of(command, error) + see;
}

} // namespace cli
